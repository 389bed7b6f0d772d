"""What is entered: an act as whoever reports it gives it, and as the chain takes it.

From here on it is text: what is hashed is what is kept, to the letter, in either database.
"""

import json
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

    at: str  # as `written` writes it
    who: str
    role: str
    credential: str
    action: str
    target: str
    why: str | None
    before: str | None  # JSON
    after: str | None
    outcome: str
    key: str | None = None


def act(entry: Entry, key: str | None = None) -> Act:
    """Who of the present context does this, now."""
    who = actor.get()
    return Act(
        at=written(datetime.now(UTC)),
        who=clean(who.name)[:LONGEST],
        role=clean(who.role)[:LONGEST],
        credential=clean(who.id)[:LONGEST],
        action=clean(entry.action)[:LONGEST],
        target=clean(entry.target)[:LONGEST],
        why=None if entry.why is None else clean(entry.why),
        before=_json(entry.before),
        after=_json(entry.after),
        outcome=DONE if entry.refused is None else f"refused: {clean(entry.refused)}"[:LONGEST],
        key=key,
    )


def written(at: datetime) -> str:
    """A time as UTC in text: the order of texts is that of times."""
    return at.astimezone(UTC).isoformat(timespec="microseconds")


def _json(data: Any) -> str | None:
    return None if data is None else json.dumps(plain(data), allow_nan=False)
