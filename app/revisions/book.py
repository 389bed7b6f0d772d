"""The document in force and all before it: adopted by the loop whole or not at all, and only then stored."""

import logging
from collections.abc import Callable
from datetime import UTC, datetime
from threading import Lock
from typing import Generic, TypeVar

from pydantic import BaseModel
from sqlalchemy.orm import Session

from app.audit.record import Entry, record
from app.db import Database
from app.errors import Refusal
from app.revisions import repository
from app.revisions.kind import Kind, Loop, Preset, Revision, Wanted
from app.revisions.models import RevisionRow
from app.revisions.refusals import conflict, unknown_revision

D = TypeVar("D", bound=BaseModel)
CONSOLE = "console"
_log = logging.getLogger(__name__)


class RevisionBook(Generic[D]):
    """The revisions of one kind. May be asked from any thread.

    `starting` is held where a run is started: no run begins while a document changes hands. `turn_to` is
    told of every document before it comes into force.
    """

    def __init__(
        self,
        kind: Kind[D],
        database: Database,
        loop: Loop[D],
        preset: Preset[D],
        starting: Lock,
        turn_to: Callable[[D], None],
    ) -> None:
        self._kind = kind
        self._database = database
        self._loop = loop
        self._preset = preset
        self._changing = starting
        self._turn_to = turn_to
        self._in_force = Revision(0, preset.document, CONSOLE, "As shipped", datetime.now(UTC))

    # ---- reading ----

    @property
    def in_force(self) -> Revision[D]:
        """The newest revision."""
        return self._in_force

    def loop_has_it(self) -> bool:
        """Whether the loop works with the document in force."""
        return self._loop.has(self._in_force.document)

    def revisions(self, before: int | None, limit: int) -> list[RevisionRow]:
        """The revisions without their documents, the newest first."""
        with self._database.reading() as session:
            return list(repository.revisions(session, self._kind.row, before, limit))

    def revision(self, number: int) -> Revision[D] | Refusal:
        """A revision with its document; 0 is the one as shipped."""
        if number == 0:
            return self._shipped()
        with self._database.reading() as session:
            row = repository.revision(session, self._kind.row, number)
            if row is None:
                return unknown_revision(self._kind, number, self._in_force.number)
            return self._read(row)

    # ---- writing ----

    def open(self) -> None:
        """Put the newest revision in force; a file that differs from it becomes a new one."""
        with self._database.writing() as session:
            self._take(self._first(session))

    def _first(self, session: Session) -> Revision[D]:
        row = repository.newest(session, self._kind.row)
        newest = None if row is None else self._read(row)
        number, preset = 1 if row is None else row.number + 1, self._preset
        if preset.file is not None:
            if isinstance(newest, Revision) and newest.document == preset.document:
                return newest
            before = newest.document if isinstance(newest, Revision) else None
            why = f"From the file {preset.file}"
            return self._store(session, number, preset.document, (CONSOLE, why), before)
        if isinstance(newest, Revision):
            return newest
        why = preset.why
        if newest is not None:
            told = (number - 1, self._kind.name, newest.detail)
            _log.error("revision %d of the %s cannot be read: %s", *told)
            why = f"{preset.why}: revision {number - 1} cannot be read any more"
        return self._store(session, number, preset.document, (CONSOLE, why), None)

    def change(self, wanted: Wanted[D]) -> Revision[D] | Refusal:
        """Put another document in force. What is refused, or cannot be stored, leaves all as it was."""
        document = self._kind.adoptable(wanted.document)
        if isinstance(document, Refusal):
            return document
        with self._changing:
            now = self._in_force
            if wanted.based_on != now.number:
                return conflict(self._kind, now, wanted.based_on)
            if document == now.document:
                return self._as_it_is(now, wanted)
            refusal = self._loop.adopt(document, wanted.lease)
            if refusal is not None:
                return refusal
            try:
                made = self._stored(document, wanted)
            except BaseException:
                self._give_back(now.document)
                raise
            self._take(made)
            if not self._loop.has(made.document):  # it was started anew meanwhile
                self._loop.give_later()
            return made

    def _stored(self, document: D, wanted: Wanted[D]) -> Revision[D]:
        with self._database.writing() as session:
            newest = repository.newest(session, self._kind.row)
            number = 1 if newest is None else newest.number + 1
            by = (wanted.author, wanted.why)
            made = self._store(session, number, document, by, self._in_force.document)
            if wanted.also is not None:
                wanted.also(session, made.number)
            return made

    def _as_it_is(self, now: Revision[D], wanted: Wanted[D]) -> Revision[D]:
        """What is in force already makes no revision."""
        if wanted.also is not None:
            with self._database.writing() as session:
                wanted.also(session, now.number)
        return now

    def _give_back(self, before: D) -> None:
        """What nobody has written down does not stay in force."""
        refusal = self._loop.adopt(before)
        if refusal is not None:
            _log.error("the loop did not take its %s back: %s", self._kind.name, refusal.detail)
            self._loop.give_later()

    def _take(self, revision: Revision[D]) -> None:
        self._turn_to(revision.document)
        self._in_force = revision

    def _shipped(self) -> Revision[D]:
        return Revision(0, self._kind.shipped(), CONSOLE, "As shipped", datetime.now(UTC))

    def _read(self, row: RevisionRow) -> Revision[D] | Refusal:
        document = self._kind.read(row.document, f"revision {row.number}")
        if isinstance(document, Refusal):
            return document
        return Revision(row.number, document, row.author, row.why, row.created_at)

    def _store(
        self, session: Session, number: int, document: D, by: tuple[str, str], before: D | None
    ) -> Revision[D]:
        """Enter a revision, and the audit of it, in one transaction."""
        author, why = by
        made = Revision(number, document, author, why, datetime.now(UTC))
        data = dict(self._kind.write(document))
        row = self._kind.row()
        row.number, row.document, row.author, row.why = number, data, author, why
        row.created_at = made.created_at
        session.add(row)
        data_before = None if before is None else dict(self._kind.write(before))
        record(session, Entry(self._kind.action, f"revision {number}", why, data_before, data))
        return made
