"""The rig in three dimensions: drawn by viser in a process of its own, seen through the app's sign-in."""
