"""A test on the virtual rig: the very tick of the loop, as fast as the processor goes."""
