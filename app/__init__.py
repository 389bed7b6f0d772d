"""Backend of the operator console: HTTP, live data, recording, analysis and reports."""
