"""The table in force and all before it: adopted by the loop whole or not at all, and only then stored."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from threading import Lock
from typing import Protocol

from sqlalchemy.orm import Session

from app.audit.record import Entry, record
from app.db import Database
from app.documents.writing import to_data
from app.errors import Refusal
from app.interlocks import repository
from app.interlocks.defaults import default_interlocks
from app.interlocks.models import InterlocksRevision
from app.interlocks.record import interlocks_from
from app.interlocks.refusals import conflict, unknown_revision
from app.interlocks.safeguards import adoptable
from app.interlocks.table import Interlocks

_log = logging.getLogger(__name__)
CONSOLE = "console"


class Loop(Protocol):
    """What adopts a table."""

    def adopt(self, interlocks: Interlocks, lease: int | None = None) -> Refusal | None:
        """Take a table over, whole or not at all; None where it did."""

    def has(self, interlocks: Interlocks) -> bool:
        """Whether it watches with this table."""

    def give_later(self) -> None:
        """Ask for the table in force as soon as that is safe."""


@dataclass(frozen=True)
class Revision:
    """A table that was adopted, by whom, when and why. Number 0 is the one as shipped."""

    number: int
    interlocks: Interlocks
    author: str
    why: str
    created_at: datetime


@dataclass(frozen=True)
class Wanted:
    """A table that somebody wants in force, on top of the revision that it was made from."""

    interlocks: Interlocks
    why: str
    based_on: int
    author: str
    lease: int | None = None


@dataclass(frozen=True)
class Preset:
    """The table that a console is started with: as shipped, or of a file that is named here."""

    interlocks: Interlocks
    file: str | None = None


class InterlockTables:
    """The tables of this rig. May be asked from any thread.

    `starting` is held where a run is started: no run begins while a table changes hands. `turn_to` is
    told of every table before it comes into force.
    """

    def __init__(
        self,
        database: Database,
        loop: Loop,
        preset: Preset,
        starting: Lock,
        turn_to: Callable[[Interlocks], None],
    ) -> None:
        self._database = database
        self._loop = loop
        self._preset = preset
        self._changing = starting
        self._turn_to = turn_to
        self._in_force = Revision(0, preset.interlocks, CONSOLE, "As shipped", datetime.now(UTC))

    # ---- reading ----

    @property
    def in_force(self) -> Revision:
        """The newest revision."""
        return self._in_force

    def loop_has_it(self) -> bool:
        """Whether the loop watches with the table in force."""
        return self._loop.has(self._in_force.interlocks)

    def revisions(self, before: int | None, limit: int) -> list[InterlocksRevision]:
        """The revisions without their tables, the newest first."""
        with self._database.reading() as session:
            return list(repository.revisions(session, before, limit))

    def revision(self, number: int) -> Revision | Refusal:
        """A revision with its table; 0 is the one as shipped."""
        if number == 0:
            return shipped()
        with self._database.reading() as session:
            row = repository.revision(session, number)
            return unknown_revision(number, self._in_force.number) if row is None else _read(row)

    # ---- writing ----

    def open(self) -> None:
        """Put the newest revision in force; a file that differs from it becomes a new one."""
        with self._database.writing() as session:
            self._take(self._first(session))

    def _first(self, session: Session) -> Revision:
        row = repository.newest(session)
        newest = None if row is None else _read(row)
        number, preset = 1 if row is None else row.number + 1, self._preset
        if preset.file is not None:
            if isinstance(newest, Revision) and newest.interlocks == preset.interlocks:
                return newest
            before = newest.interlocks if isinstance(newest, Revision) else None
            why = f"From the file {preset.file}"
            return _store(session, number, preset.interlocks, (CONSOLE, why), before)
        if isinstance(newest, Revision):
            return newest
        why = "As shipped"
        if newest is not None:
            _log.error(
                "revision %d of the interlocks cannot be read: %s", number - 1, newest.detail
            )
            why = f"As shipped: revision {number - 1} cannot be read any more"
        return _store(session, number, shipped().interlocks, (CONSOLE, why), None)

    def change(self, wanted: Wanted) -> Revision | Refusal:
        """Put another table in force. What is refused, or cannot be stored, leaves all as it was."""
        table = adoptable(wanted.interlocks)
        if isinstance(table, Refusal):
            return table
        with self._changing:
            now = self._in_force
            if wanted.based_on != now.number:
                return conflict(now.number, now.author, now.created_at, wanted.based_on)
            if table == now.interlocks:
                return now
            refusal = self._loop.adopt(table, wanted.lease)
            if refusal is not None:
                return refusal
            try:
                made = self._stored(table, wanted)
            except BaseException:
                self._give_back(now.interlocks)
                raise
            self._take(made)
            if not self._loop.has(made.interlocks):  # it was started anew meanwhile
                self._loop.give_later()
            return made

    def _stored(self, table: Interlocks, wanted: Wanted) -> Revision:
        with self._database.writing() as session:
            newest = repository.newest(session)
            number = 1 if newest is None else newest.number + 1
            by = (wanted.author, wanted.why)
            return _store(session, number, table, by, self._in_force.interlocks)

    def _give_back(self, before: Interlocks) -> None:
        """What nobody has written down does not stay in force."""
        refusal = self._loop.adopt(before)
        if refusal is not None:
            _log.error("the loop did not take its interlocks back: %s", refusal.detail)
            self._loop.give_later()

    def _take(self, revision: Revision) -> None:
        self._turn_to(revision.interlocks)
        self._in_force = revision


def shipped() -> Revision:
    """The table that comes with this version, as revision 0."""
    return Revision(0, default_interlocks(), CONSOLE, "As shipped", datetime.now(UTC))


def _read(row: InterlocksRevision) -> Revision | Refusal:
    table = interlocks_from(row.document, f"revision {row.number}")
    if isinstance(table, Refusal):
        return table
    return Revision(row.number, table, row.author, row.why, row.created_at)


def _store(
    session: Session,
    number: int,
    table: Interlocks,
    by: tuple[str, str],
    before: Interlocks | None,
) -> Revision:
    """Enter a revision, and the audit of it, in one transaction."""
    author, why = by
    made = Revision(number, table, author, why, datetime.now(UTC))
    session.add(
        InterlocksRevision(
            number=number,
            document=to_data(table),
            author=author,
            why=why,
            created_at=made.created_at,
        )
    )
    data_before = None if before is None else to_data(before)
    entry = Entry("interlocks.change", f"revision {number}", why, data_before, to_data(table))
    record(session, entry)
    return made
