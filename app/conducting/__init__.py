"""Frequency responses while they are played: the points so far, and which part of the test may be left out."""
