"""The rule of retention: which runs' samples go. It looks at neither clock nor disk."""

from collections.abc import Iterable, Set
from dataclasses import dataclass
from datetime import datetime, timedelta

from app.storage.schemas import Leaving

_DAY_S = 86_400.0


@dataclass(frozen=True)
class Limits:
    """How long samples are kept; None for no limit. Runs with one of the tags keep theirs."""

    keep_days: float | None = None
    keep_bytes: int | None = None
    keep_tags: tuple[str, ...] = ()

    @property
    def limited(self) -> bool:
        """Whether anything goes at all."""
        return self.keep_days is not None or self.keep_bytes is not None


@dataclass(frozen=True)
class Kept:
    """A run that is over and has its samples."""

    id: int
    test_name: str
    ended_at: datetime
    bytes: int


def leaving(rule: Limits, runs: Iterable[Kept], tagged: Set[int], now: datetime) -> list[Leaving]:
    """The runs whose samples go, oldest first: those too old, then the oldest of too many bytes."""
    known = sorted(runs, key=lambda run: run.id)
    gone: list[Leaving] = []
    total = sum(run.bytes for run in known)
    for run in known:
        reason = None if run.id in tagged else _reason(rule, run, total, now)
        if reason is not None:
            total -= run.bytes
            gone.append(_leaving(run, reason))
    return gone


def _reason(rule: Limits, run: Kept, total: int, now: datetime) -> str | None:
    if rule.keep_days is not None:
        age_s = (now - run.ended_at) / timedelta(seconds=1)
        if age_s > rule.keep_days * _DAY_S:
            return f"older than {rule.keep_days:g} days"
    if rule.keep_bytes is not None and total > rule.keep_bytes:
        return f"samples of all runs take more than {rule.keep_bytes / 1e9:,.3g} GB"
    return None


def _leaving(run: Kept, reason: str) -> Leaving:
    return Leaving(
        id=run.id, test_name=run.test_name, ended_at=run.ended_at, bytes=run.bytes, reason=reason
    )
