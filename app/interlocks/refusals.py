"""Why something about the interlocks is refused, in sentences that say what to do."""

from datetime import datetime

from app.errors import Code, Refusal


def conflict(newest: int, author: str, at: datetime, based_on: int) -> Refusal:
    """Somebody else changed them in the meantime."""
    detail = (
        f"{author} put revision {newest} of the interlocks in force at {at:%Y-%m-%d %H:%M:%S} UTC, and"
        f" this was made from revision {based_on}: look at the difference, then change revision {newest}"
    )
    about = {"current_revision": newest, "author": author, "saved_at": at.isoformat()}
    return Refusal(Code.EDIT_CONFLICT, detail, about=about)


def unknown_revision(number: int, newest: int) -> Refusal:
    """There is no such revision."""
    detail = f"The interlocks have no revision {number}: the newest is {newest}"
    return Refusal(Code.UNKNOWN_REVISION, detail, about={"current_revision": newest})
