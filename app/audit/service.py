"""The audit of one data directory: kept while a console runs, read and verified at any time."""

from pathlib import Path

from app.audit import repository
from app.audit.head import HEAD_FILE, Head
from app.audit.notes import Notes
from app.audit.record import take_notes
from app.audit.schemas import AuditEntry, AuditPage, Verification
from app.audit.sought import Sought
from app.audit.spool import SPOOL_FILE, Spool
from app.audit.verifying import verify
from app.db import Database


class Audit:
    """Reading it needs neither `open`, as a console does, nor `follow`."""

    def __init__(self, database: Database, data_dir: Path) -> None:
        self._database = database
        self._data_dir = data_dir
        self._notes: Notes | None = None

    def open(self) -> None:
        """Keep the end of the chain, and take what is noted from now on."""
        self.follow()
        self._notes = Notes(self._database, Spool(self._data_dir / SPOOL_FILE))
        self._notes.start()
        take_notes(self._notes.take)

    def follow(self) -> None:
        """Keep the end of the chain: whoever changes the database does, a command as a console."""
        Head(self._data_dir / HEAD_FILE).follow(self._database)

    def close(self) -> None:
        """Enter what was noted, or leave it in the file for the next console."""
        take_notes(None)
        if self._notes is not None:
            self._notes.close()

    def page(self, sought: Sought, limit: int, before: int | None) -> AuditPage:
        """The newest entries among those that are sought, or those before a number."""
        with self._database.reading() as session:
            rows = repository.page(session, sought, limit + 1, before)
            entries = [AuditEntry.model_validate(row) for row in rows[:limit]]
        return AuditPage(entries=entries, next=entries[-1].id if len(rows) > limit else None)

    def verify(self) -> Verification:
        """Whether every row is as it was entered, and none is gone."""
        return verify(self._database, self._data_dir / HEAD_FILE)
