"""Recording: every tick of every run, from the ring to a file that survives a kill in mid-write."""
