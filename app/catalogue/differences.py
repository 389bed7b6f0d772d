"""What two revisions of a test differ in."""

from app.catalogue.models import TestRevision
from app.catalogue.schemas import ChangeOut, Difference
from app.definitions.difference import data_differences, text_difference


def difference_of(before: TestRevision, after: TestRevision) -> Difference:
    """From one revision to another; comments differ in the text alone."""
    found = data_differences(before.definition, after.definition)
    return Difference(
        before=before.number,
        to=after.number,
        changes=[ChangeOut.model_validate(change, from_attributes=True) for change in found],
        text=text_difference(before.yaml, after.yaml, (_title(before), _title(after))),
    )


def _title(revision: TestRevision) -> str:
    return f"{revision.test_id} revision {revision.number}"
