"""What is kept of a run beside the record of every tick: tables that are small enough to be read."""
