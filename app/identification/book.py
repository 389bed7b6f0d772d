"""Writes down the identifications: that one was begun, what came of it, and who adopted it."""

from collections.abc import Callable, Sequence
from datetime import UTC, datetime

from sqlalchemy.orm import Session

from app.audit.entry import Entry
from app.audit.record import record
from app.db import Database
from app.errors import Code, Refusal
from app.identification import repository
from app.identification.models import UNDER_WAY, Identification, State
from app.identification.schemas import Identified

LONGEST_REASON = 500


class Book:
    """The identifications of this data directory."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def enter(self, row: Identification) -> int:
        """Enter one that waits for its turn; its number."""
        with self._database.writing() as session:
            session.add(row)
            session.flush()
            told = {"run_ids": row.run_ids, "fit": row.fit, "based_on": row.based_on}
            record(session, Entry("identifications.start", _name(row.id), after=told))
            return row.id

    def begun(self, number: int) -> None:
        """It is its turn."""
        self._change(number, lambda row: setattr(row, "state", State.RUNNING))

    def done(self, number: int, found: Identified) -> None:
        """It has come to an end, and this came of it."""

        def change(row: Identification) -> None:
            row.state, row.ended_at = State.DONE, datetime.now(UTC)
            row.result = found.model_dump(mode="json")

        self._change(number, change)

    def ended(self, number: int, state: State, reason: str) -> None:
        """Nothing came of it, and why."""

        def change(row: Identification) -> None:
            row.state, row.ended_at = state, datetime.now(UTC)
            row.reason = reason[:LONGEST_REASON]

        self._change(number, change)

    def interrupt_all(self, reason: str) -> None:
        """An earlier start of the console has left these."""
        with self._database.reading() as session:
            numbers = [row.id for row in repository.under_way(session)]
        for number in numbers:
            self.ended(number, State.INTERRUPTED, reason)

    def adopted(self, session: Session, number: int, revision: int, why: str) -> None:
        """Its model comes into force, in the transaction of the revision itself."""
        row = repository.to_change(session, number)
        if row is not None:
            row.adopted_revision = revision
        told = {"rig_configuration": revision}
        record(session, Entry("identifications.adopt", _name(number), why, after=told))

    def remove(self, number: int) -> Refusal | None:
        """Forget one that has ended and whose model was not adopted."""
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is None:
                return unknown(number)
            if row.state in UNDER_WAY:
                detail = f"Identification {number} is under way: cancel it first"
                return Refusal(Code.BUSY, detail)
            if row.adopted_revision is not None:
                detail = (
                    f"Identification {number} stays: revision {row.adopted_revision} of the rig"
                    " configuration was made from it"
                )
                return Refusal(Code.BUSY, detail)
            record(session, Entry("identifications.remove", _name(number), before=row.run_ids))
            session.delete(row)
        return None

    def get(self, number: int) -> Identification | Refusal:
        """One by its number."""
        with self._database.reading() as session:
            return repository.get(session, number) or unknown(number)

    def page(self, limit: int, before: int | None) -> Sequence[Identification]:
        """The newest, or those before a number."""
        with self._database.reading() as session:
            return repository.page(session, limit, before)

    def _change(self, number: int, change: Callable[[Identification], None]) -> None:
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is not None and row.state in UNDER_WAY:
                change(row)


def unknown(number: int) -> Refusal:
    """There is none of this number."""
    return Refusal(Code.NOT_FOUND, f"There is no identification {number}")


def _name(number: int) -> str:
    return f"identification {number}"
