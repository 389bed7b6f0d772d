"""Who is in command: one lease of the rig, whose epoch every command bears and the loop itself checks."""
