"""Runs: what was tested when, with which settings, how it ended, and the samples."""
