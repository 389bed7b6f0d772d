"""What two revisions of a test differ in."""

from difflib import unified_diff

from app.catalogue.models import TestRevision
from app.catalogue.schemas import Difference


def difference_of(before: TestRevision, after: TestRevision) -> Difference:
    """From one revision to another; they may be of different tests."""
    old, new = (revision.yaml.splitlines(keepends=True) for revision in (before, after))
    lines = unified_diff(old, new, _title(before), _title(after))
    text = "".join(line if line.endswith("\n") else f"{line}\n" for line in lines)
    return Difference(**{"from": before.number}, to=after.number, changes=[], text=text)


def _title(revision: TestRevision) -> str:
    return f"{revision.test_id} revision {revision.number}"
