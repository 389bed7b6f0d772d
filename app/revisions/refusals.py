"""Why something about a revision is refused, in sentences that say what to do."""

from typing import Any

from app.errors import Code, Refusal
from app.revisions.kind import Kind, Revision


def conflict(kind: Kind[Any], now: Revision[Any], based_on: int) -> Refusal:
    """Somebody else changed it in the meantime."""
    detail = (
        f"{now.author} put revision {now.number} of the {kind.name} in force at"
        f" {now.created_at:%Y-%m-%d %H:%M:%S} UTC, and this was made from revision {based_on}:"
        f" look at the difference, then change revision {now.number}"
    )
    about = {
        "current_revision": now.number,
        "author": now.author,
        "saved_at": now.created_at.isoformat(),
    }
    return Refusal(Code.EDIT_CONFLICT, detail, about=about)


def unknown_revision(kind: Kind[Any], number: int, newest: int) -> Refusal:
    """There is no such revision."""
    detail = f"The {kind.name} {kind.verb} no revision {number}: the newest is {newest}"
    return Refusal(Code.UNKNOWN_REVISION, detail, about={"current_revision": newest})
