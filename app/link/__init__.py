"""The link to the loop process: the only part of the app that touches the shared block."""
