"""The settings of the control law: what they may be, which are shipped, what the loop gets."""
