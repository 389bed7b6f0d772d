"""The simulated rig: a servo-hydraulic load actuator, the structure, and the unit under test."""
