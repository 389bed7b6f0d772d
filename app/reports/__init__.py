"""Reports: what a run was, with what, and what came of it, as PDF and HTML from one model."""
