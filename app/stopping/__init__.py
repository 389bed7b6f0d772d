"""Stop on a path of its own: a port and threads that need neither event loop, database, lease nor command ring."""
