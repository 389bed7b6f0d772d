"""Tables as requests give and take them."""

from typing import Any

from app.errors import Refusal
from app.interlocks.check_schemas import InterlocksCheck, Weakened
from app.interlocks.difference import difference
from app.interlocks.safeguards import GUARDED, adoptable, shortfalls
from app.interlocks.schemas import (
    DetectorChangeOut,
    InterlocksDifference,
    InterlocksOut,
    InterlocksText,
    RevisionOut,
    TableRevision,
)
from app.interlocks.table import Interlocks
from app.problems import FaultOut
from app.revisions.kind import Revision
from app.revisions.models import RevisionRow


def document(body: InterlocksText) -> dict[str, Any]:
    """The table in a request, as plain data."""
    return {"detectors": body.detectors, "knowingly_weaker": body.knowingly_weaker}


def in_force(revision: Revision[Interlocks], *, in_loop: bool) -> InterlocksOut:
    """The newest revision."""
    return InterlocksOut(
        revision=revision.number,
        author=revision.author,
        why=revision.why,
        created_at=revision.created_at,
        in_loop=in_loop,
        detectors=revision.document.detectors,
        knowingly_weaker=revision.document.knowingly_weaker,
        guarded=GUARDED,
    )


def summary(row: RevisionRow) -> TableRevision:
    """A revision without its table."""
    return TableRevision.model_validate(row, from_attributes=True)


def revision(found: Revision[Interlocks]) -> RevisionOut:
    """A revision with its table."""
    return RevisionOut(
        number=found.number,
        author=found.author,
        why=found.why,
        created_at=found.created_at,
        detectors=found.document.detectors,
        knowingly_weaker=found.document.knowingly_weaker,
    )


def difference_of(
    before: Interlocks, after: Interlocks, numbers: tuple[int | None, int | None]
) -> InterlocksDifference:
    """What two tables differ in."""
    found = difference(before, after)
    return InterlocksDifference(
        before=numbers[0],
        to=numbers[1],
        detectors=[
            DetectorChangeOut.model_validate(change, from_attributes=True)
            for change in found.detectors
        ],
        reordered=found.reordered,
    )


def checked(table: Interlocks | Refusal, now: Revision[Interlocks]) -> InterlocksCheck:
    """Whether a table could be put in force on top of this revision."""
    if isinstance(table, Refusal):
        errors = [FaultOut.of(fault) for fault in table.faults]
        return InterlocksCheck(valid=False, errors=errors, weakened=[], difference=None)
    found = adoptable(table)
    faults = found.faults if isinstance(found, Refusal) else ()
    return InterlocksCheck(
        valid=not isinstance(found, Refusal),
        errors=[FaultOut.of(fault) for fault in faults],
        weakened=[Weakened(detector=s.detector, text=s.text) for s in shortfalls(table)],
        difference=difference_of(now.document, table, (now.number, None)),
    )
