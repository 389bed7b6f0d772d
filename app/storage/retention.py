"""Removing the samples of old runs. Their entries in the book stay, and say so."""

import logging
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from threading import Lock

from app.audit.record import Entry, record
from app.db import Database
from app.errors import Code, Refusal
from app.recording.files import remove_samples
from app.runs.models import Run
from app.storage import repository
from app.storage.models import Retention
from app.storage.rule import Kept, Limits, leaving
from app.storage.schemas import Leaving, RetentionChange, RetentionOut, RetentionPreview
from app.storage.space import bytes_of

_log = logging.getLogger(__name__)
DAILY = timedelta(days=1)


class Retainer:
    """Applies the rule: once a day, and when it is asked to."""

    def __init__(
        self,
        database: Database,
        runs_dir: Path,
        now: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._now = now
        self._applying = Lock()

    def rule(self) -> RetentionOut:
        """The rule in force."""
        with self._database.reading() as session:
            return _shown(repository.retention(session))

    def preview(self, limits: Limits | None = None) -> RetentionPreview:
        """What these limits remove if they are applied now, or those in force."""
        runs = self._leaving(limits or _limits(self.rule()))
        return RetentionPreview(runs=runs, bytes=sum(run.bytes for run in runs))

    def change(self, change: RetentionChange) -> RetentionOut | Refusal:
        """Give another rule; refused where somebody else has changed it meanwhile."""
        with self._database.writing() as session:
            row = repository.retention(session)
            if row.revision != change.based_on:
                detail = (
                    f"Somebody has changed the rule of retention meanwhile: it is at revision "
                    f"{row.revision}, this change was made from {change.based_on}. Look at it again"
                )
                return Refusal(Code.EDIT_CONFLICT, detail)
            before = _limits(_shown(row))
            row.keep_days, row.keep_bytes = change.keep_days, change.keep_bytes
            row.keep_tags = list(dict.fromkeys(change.keep_tags))
            row.revision += 1
            rule = _shown(row)
            record(session, Entry("storage.rule", "retention", before=before, after=_limits(rule)))
        _log.info("retention: rule %d: %s", rule.revision, _in_words(rule))
        if change.apply:
            self.apply()
            return self.rule()
        return rule

    def apply(self) -> list[Leaving]:
        """Remove what the rule says, now. First the book says so, then the samples go."""
        with self._applying:
            runs = self._leaving(_limits(self.rule()))
            with self._database.writing() as session:
                repository.mark_removed(session, [run.id for run in runs], self._now())
                repository.retention(session).applied_at = self._now()
                if runs:
                    removed = [run.model_dump(include={"id", "bytes", "reason"}) for run in runs]
                    record(session, Entry("storage.remove_samples", "runs", after=removed))
            for run in runs:
                remove_samples(self._runs_dir / str(run.id))
                _log.info("retention: run %d: %d bytes removed, %s", run.id, run.bytes, run.reason)
            return runs

    def apply_daily(self) -> None:
        """Apply it if a day has gone by since the last time, and there is one."""
        rule = self.rule()
        if _limits(rule).limited and (
            rule.applied_at is None or self._now() - rule.applied_at >= DAILY
        ):
            self.apply()

    def finish_removing(self) -> None:
        """At a start: remove what a kill left of the samples of runs whose entries say they are gone."""
        with self._database.reading() as session:
            gone = repository.removed(session)
        for run_id in gone:
            remove_samples(self._runs_dir / str(run_id))

    def _leaving(self, limits: Limits) -> list[Leaving]:
        if not limits.limited:
            return []
        with self._database.reading() as session:
            runs = [self._kept(run) for run in repository.with_samples(session)]
            tagged = repository.tagged(session, limits.keep_tags)
        return leaving(limits, runs, tagged, self._now())

    def _kept(self, run: Run) -> Kept:
        ended_at = run.ended_at or run.started_at
        return Kept(run.id, run.test_name, ended_at, bytes_of(self._runs_dir / str(run.id)))


def _shown(row: Retention) -> RetentionOut:
    return RetentionOut.model_validate(row, from_attributes=True)


def _limits(rule: RetentionOut) -> Limits:
    return Limits(rule.keep_days, rule.keep_bytes, tuple(rule.keep_tags))


def _in_words(rule: RetentionOut) -> str:
    kept = [f"{rule.keep_days:g} days"] if rule.keep_days is not None else []
    kept += [f"{rule.keep_bytes} bytes"] if rule.keep_bytes is not None else []
    always = f", always those tagged {', '.join(rule.keep_tags)}" if rule.keep_tags else ""
    return f"keep {' and '.join(kept) or 'everything'}{always}"
