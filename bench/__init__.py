"""Benchmarks: each prints figures and a ratio to a reference run beside it."""
