"""One export: what is made of which run, and how far it is."""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path

from app.exports.extract import Extract
from app.exports.formats import FormatName
from app.exports.schemas import ExportOut
from app.jobs.jobs import Job, JobState
from app.jobs.schemas import JobOut

KEPT = timedelta(hours=1)


@dataclass(frozen=True)
class Export:
    """It is at `path` once its job is done."""

    user_id: int | None  # who wants it
    run_id: int
    format: FormatName
    wanted: Extract
    path: Path
    job: Job[int]

    def shown(self) -> ExportOut:
        """As it is told."""
        first_s = self.wanted.from_s
        return ExportOut(
            **JobOut.of(self.job).model_dump(),
            run_id=self.run_id,
            format=self.format,
            channels=list(self.wanted.names),
            from_s=round(first_s, 9),
            to_s=round(first_s + (self.wanted.ticks - 1) * self.wanted.period_s, 9),
            size_bytes=self.job.result,
            kept_until=self._kept_until(),
        )

    def is_old(self, now: datetime) -> bool:
        """Whether it has been kept for long enough, or nothing came of it that could be kept."""
        if not self.job.ended.is_set():
            return False
        until = self._kept_until()
        return now > (until or self.job.made_at + KEPT)

    def _kept_until(self) -> datetime | None:
        if self.job.state is not JobState.DONE:
            return None
        try:
            made = self.path.stat().st_mtime
        except OSError:
            return None
        return datetime.fromtimestamp(made, UTC) + KEPT
