"""Runs beside one another: overlaid, measured, with the settings that differ; and a measurement over many runs."""
