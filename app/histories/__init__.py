"""Time histories: samples from CSV files, kept on disk, and the smooth curve that runs through them."""
