"""Data sheets of a rig under a controller: static characteristic, loop and compensator, as figures 5 and 11 show."""
