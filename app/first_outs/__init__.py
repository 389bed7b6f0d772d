"""First-outs: what took the load off, with every tick around it, to look at, replay and re-run."""
