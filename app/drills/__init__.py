"""Drills: faults given to the simulated rig on purpose, each with the reaction that is expected, and scored."""
