"""Frequency response: estimates of transfers with their uncertainty, from recorded or live columns."""
