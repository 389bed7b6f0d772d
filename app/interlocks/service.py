"""The table in force and all before it."""

from app.interlocks.defaults import default_interlocks
from app.interlocks.models import InterlocksRevision
from app.interlocks.record import interlocks_from
from app.interlocks.safeguards import adoptable
from app.interlocks.table import Interlocks
from app.revisions.book import RevisionBook
from app.revisions.kind import Kind, Preset, Revision, Wanted

__all__ = ["INTERLOCKS", "InterlockTables", "Preset", "Revision", "Wanted"]

INTERLOCKS = Kind(
    "interlocks",
    "interlocks.change",
    InterlocksRevision,
    default_interlocks,
    interlocks_from,
    adoptable,
)
InterlockTables = RevisionBook[Interlocks]
