"""What entries of the audit are asked for."""

from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import ColumnElement

from app.audit.entry import written
from app.audit.models import AuditRow
from app.runs.words import MOST_WORDS, words_of


@dataclass(frozen=True)
class Sought:
    """What is None or empty does not matter. `action` may be the first part alone: `tests`."""

    who: str | None = None
    action: str | None = None
    target: str | None = None
    since: datetime | None = None
    until: datetime | None = None  # and not then
    search: str = ""

    def conditions(self) -> list[ColumnElement[bool]]:
        """All of them, on the table."""
        found: list[ColumnElement[bool]] = []
        if self.who:
            found.append(AuditRow.who == self.who)
        if self.action:
            found.append(AuditRow.action.startswith(self.action, autoescape=True))
        if self.target:
            found.append(AuditRow.target == self.target)
        if self.since is not None:
            found.append(AuditRow.at >= written(self.since))
        if self.until is not None:
            found.append(AuditRow.at < written(self.until))
        words = words_of([self.search])[:MOST_WORDS]
        return [*found, *(AuditRow.words.contains(f" {word}") for word in words)]
