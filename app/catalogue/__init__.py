"""The tests: saved as revisions, found, compared, taken in and out as files."""
