"""What the lab knows of its rig: the model in force, calibrations, limits, and what is mounted in it."""
