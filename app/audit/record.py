"""What every change calls: `record` in its own transaction, `note` where it has none."""

from collections.abc import Callable, Iterable
from uuid import uuid4

from sqlalchemy import event
from sqlalchemy.orm import Session

from app.audit import repository
from app.audit.entry import Act, Entry, act

__all__ = ["APPENDED", "Entry", "enter", "note", "record", "take_notes"]

_WAITING = "audit_waiting"
APPENDED = "audit_appended"  # in `session.info`: the end before, and the rows that were added
_takers: list[Callable[[Act], None]] = []


def record(session: Session, entry: Entry) -> None:
    """Enter an act together with the change that it tells of: both are committed, or neither.

    It is chained on as the last thing before the commit, whenever this is called: so changes
    wait for one another's place in the chain only for that moment.
    """
    enter(session, [act(entry)])


def note(entry: Entry) -> None:
    """Enter an act that has no transaction: returns at once, and the console writes it soon after.

    Where no console is open in this process, nobody keeps it.
    """
    noted = act(entry, uuid4().hex)
    for take in _takers:
        take(noted)


def enter(session: Session, acts: Iterable[Act]) -> None:
    """Enter acts with the commit of this transaction; those with keys that are in it already, not."""
    session.info.setdefault(_WAITING, []).extend(acts)


def take_notes(taker: Callable[[Act], None] | None) -> None:
    """Who takes what is noted in this process: None for nobody."""
    _takers[:] = [] if taker is None else [taker]


@event.listens_for(Session, "before_commit")
def _chain_on(session: Session) -> None:
    waiting = session.info.pop(_WAITING, None)
    if waiting:
        session.flush()  # whatever locks the change needs, it has them before the chain's
        session.info[APPENDED] = repository.append(session, waiting)
