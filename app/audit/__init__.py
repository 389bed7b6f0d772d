"""The audit: who did what, when and why, in a chain that shows where it was tampered with."""
