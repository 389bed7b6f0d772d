"""Vector figures: restrained, readable in black and white, the same bytes for the same data."""
