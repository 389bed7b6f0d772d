"""Recordings in the formats of other programs: channels and window chosen, in bounded memory."""
