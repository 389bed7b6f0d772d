"""The sections of a report: each a function from the subject to a section, or None where it has nothing to say."""
