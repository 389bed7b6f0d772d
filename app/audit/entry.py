"""What is entered: an act as whoever reports it gives it, and as the chain takes it."""

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from app.audit.actor import actor
from app.audit.plain import clean, plain

DONE = "done"
LONGEST = 200  # of a name


@dataclass(frozen=True)
class Entry:
    """What was done (`tests.save`) to what (`harmonic-2-kn`), why, and what it was before and after.

    `refused` is the code of the refusal where it was not done.
    """

    action: str
    target: str
    why: str | None = None
    before: Any = None
    after: Any = None
    refused: str | None = None


@dataclass(frozen=True)
class Act:
    """An entry with who and when: plain and without secrets, whatever becomes of it from here on.

    `key` tells apart acts that wait in the spool; None where the row is written at once.
    """

    at: datetime
    who: str
    role: str
    credential: str
    action: str
    target: str
    why: str | None
    before: Any
    after: Any
    outcome: str
    key: str | None = None


def act(entry: Entry, key: str | None = None) -> Act:
    """Who of the present context does this, now."""
    who = actor.get()
    return Act(
        at=datetime.now(UTC),
        who=clean(who.name)[:LONGEST],
        role=clean(who.role)[:LONGEST],
        credential=clean(who.id)[:LONGEST],
        action=clean(entry.action)[:LONGEST],
        target=clean(entry.target)[:LONGEST],
        why=None if entry.why is None else clean(entry.why),
        before=plain(entry.before),
        after=plain(entry.after),
        outcome=DONE if entry.refused is None else f"refused: {clean(entry.refused)}"[:LONGEST],
        key=key,
    )
