"""What `forcerig run` does with a running console: ask, drive, report."""
