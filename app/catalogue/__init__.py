"""The tests that can be run: for now those that ship with forcerig."""
