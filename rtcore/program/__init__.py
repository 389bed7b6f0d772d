"""The load program: a table of segments, and the generator that turns it into a setpoint each tick."""
