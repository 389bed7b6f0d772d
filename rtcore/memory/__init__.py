"""The block of memory that the loop and the app share, and the rules by which each may touch it."""
