"""Finding runs among a million: one query for every combination of words, facets and times.

Words and facets are all in one index of words (`app.runs.words`), which each database walks from
the newest run back; so rare and common ones together cost no more than the rarest of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import (
    ColumnElement,
    ScalarSelect,
    Select,
    cast,
    column,
    func,
    literal_column,
    select,
    table,
)
from sqlalchemy.dialects.postgresql import TSQUERY
from sqlalchemy.orm import InstrumentedAttribute, Session

from app.db import BigInt
from app.runs.models import Run
from app.runs.words import MOST_WORDS, facet, words_of

UNDER_WAY = "under_way"


@dataclass(frozen=True)
class Sought:
    """What runs are asked for; what is None or empty does not matter."""

    search: str = ""
    test_id: str | None = None
    tag: str | None = None
    outcome: str | None = None  # `under_way` where it has none
    verdict: str | None = None
    operator: str | None = None
    since: datetime | None = None
    until: datetime | None = None  # and not then

    @property
    def words(self) -> list[str]:
        """The beginnings of words that a run must have."""
        return words_of([self.search])[:MOST_WORDS]

    @property
    def facets(self) -> list[str]:
        """The facets that a run must have."""
        asked = {
            "test_id": self.test_id,
            "tag": self.tag,
            "outcome": None if self.outcome == UNDER_WAY else self.outcome,
            "verdict": self.verdict,
            "operator": self.operator,
        }
        return [facet(name, value) for name, value in asked.items() if value]


def ids(session: Session, sought: Sought, before: int | None, limit: int) -> Sequence[int]:
    """The numbers of the runs that are sought, the newest first."""
    times = _times(sought)
    conditions = [*times, *([Run.outcome.is_(None)] if sought.outcome == UNDER_WAY else [])]
    number: ColumnElement[int] = Run.__table__.c.id
    if sought.words or sought.facets:
        number = _WITH_WORDS[session.get_bind().dialect.name](sought, conditions)
        conditions += _between(sought, times, number)
    if before is not None:
        conditions.append(number < before)
    query = select(number).where(*conditions).order_by(number.desc()).limit(limit)
    return session.scalars(query).all()


def _times(sought: Sought) -> list[ColumnElement[bool]]:
    found = []
    if sought.since is not None:
        found.append(Run.started_at >= sought.since)
    if sought.until is not None:
        found.append(Run.started_at < sought.until)
    return found


def _between(
    sought: Sought, times: list[ColumnElement[bool]], number: ColumnElement[int]
) -> list[ColumnElement[bool]]:
    """Between which numbers the times lie: the walk through the words begins and ends there.

    Clocks are put right now and then, so the times themselves are asked for as well.
    """
    first, last = (select(of(Run.id)).where(*times) for of in (func.min, func.max))
    found = [number >= _by_time(first)] if sought.since is not None else []
    return [*found, number <= _by_time(last)] if sought.until is not None else found


def _by_time(query: Select[int]) -> ScalarSelect[int]:
    return query.with_hint(Run, "INDEXED BY runs_started", "sqlite").scalar_subquery()


def _sqlite(sought: Sought, conditions: list[ColumnElement[bool]]) -> ColumnElement[int]:
    words = " AND ".join([*sought.facets, *(f"{word}*" for word in sought.words)])
    if conditions:
        # The + keeps SQLite from looking up a million runs in the index of words one by one.
        conditions.append(Run.id == _INDEX.c.rowid.op("+")(0))
    conditions.append(literal_column("runs_words").op("MATCH")(words))
    return _INDEX.c.rowid


def _postgresql(sought: Sought, conditions: list[ColumnElement[bool]]) -> ColumnElement[int]:
    words = [*(f"'{word}'" for word in sought.facets), *(f"'{word}':*" for word in sought.words)]
    asked = cast(" & ".join(words), TSQUERY)
    conditions.append(literal_column("runs.words_index").op("@@")(asked))
    return Run.__table__.c.id


_INDEX = table("runs_words", column("rowid", BigInt))
_WITH_WORDS = {"sqlite": _sqlite, "postgresql": _postgresql}


def each(session: Session, of: InstrumentedAttribute[str]) -> list[str]:
    """The different values of an indexed column in order: one step in the index for each."""
    found = select(func.min(of).label("value")).cte("found", recursive=True)
    following = select(func.min(of)).where(of > found.c.value).scalar_subquery()
    found = found.union_all(select(following).where(found.c.value.is_not(None)))
    query = select(found.c.value).where(found.c.value.is_not(None))
    return list(session.scalars(query))
