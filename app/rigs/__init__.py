"""The rig: its status, and the commands that an operator gives."""
