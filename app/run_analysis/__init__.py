"""The analysis of a run in the time domain: computed once, in a process apart, and kept in its folder."""
