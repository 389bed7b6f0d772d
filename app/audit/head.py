"""Where the chain ends, in a small file beside the data: it tells when rows at the end are removed.

It is written after each commit, so it may lag by what was committed just before a kill. It is never
written over one that the database contradicts: what it knows of rows that are gone stays.
"""

import json
import logging
from pathlib import Path
from threading import Lock

from sqlalchemy import event
from sqlalchemy.orm import Session

from app.audit import repository
from app.audit.chain import START, Link
from app.audit.record import APPENDED
from app.db import Database
from app.recording.whole_file import whole_file

_log = logging.getLogger(__name__)
HEAD_FILE = "audit-head.json"


class Head:
    """Keeps the file of one database."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = Lock()
        self._end = START
        self._contradicted = False

    def follow(self, database: Database) -> None:
        """Look whether the file agrees, and keep it from now on."""
        kept = read_head(self._path)  # before the rows: it may only lag
        with database.reading() as session:
            newest = repository.newest(session)
            if kept is not None:
                self._contradicted = repository.link(session, kept.id) != kept
                self._end = kept
        if kept is None and newest == START and not self._path.exists():
            self._write(START)
        elif kept is None or self._contradicted:
            self._contradicted = True
            _log.error(
                "audit: %s does not agree with the database: forcerig audit verify", self._path
            )
        event.listen(database.writers, "after_commit", self._committed)

    def _committed(self, session: Session) -> None:
        appended: list[Link] | None = session.info.get(APPENDED)
        if not appended:
            return
        with self._lock:
            if self._end in appended or self._end.id < appended[0].id:
                self._advance(appended[-1])
            elif self._end.id <= appended[-1].id:
                self._contradicted = True  # a row of that number was there, and was another one

    def _advance(self, end: Link) -> None:
        self._end = end
        if not self._contradicted:
            self._write(end)

    def _write(self, end: Link) -> None:
        try:
            with whole_file(self._path) as file:
                file.write(json.dumps({"rows": end.id, "hash": end.hash}).encode())
        except OSError as error:  # the rows are in the database all the same
            _log.warning("audit: %s could not be written: %s", self._path, error)


def read_head(path: Path) -> Link | None:
    """What the file says; None where there is none, or none that can be read."""
    try:
        told = json.loads(path.read_bytes())
        return Link(int(told["rows"]), str(told["hash"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
