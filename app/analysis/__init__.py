"""Pure functions over recorded samples."""
