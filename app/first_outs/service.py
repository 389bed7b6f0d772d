"""What can be asked about first-outs, and noted of them."""

from collections.abc import Callable, Sequence
from pathlib import Path

from app.audit.entry import Entry
from app.audit.record import record
from app.db import Database
from app.errors import Code, Refusal
from app.first_outs import files, repository
from app.first_outs.account import Account
from app.first_outs.models import FirstOut
from app.first_outs.repository import Sought
from app.first_outs.schemas import FirstOutDetail, FirstOutNote, FirstOutPage, FirstOutSummary
from app.runs.samples import known_channels, window_of
from app.runs.schemas import RunSamples


class FirstOuts:
    """The first-outs of this data directory; `trouble` says why one is not kept yet."""

    def __init__(self, database: Database, folder: Path, trouble: Callable[[], str | None]) -> None:
        self._database = database
        self._folder = folder
        self._trouble = trouble

    def page(self, sought: Sought, limit: int, before: int | None) -> FirstOutPage:
        """The newest first-outs among those that are sought, or those before a number."""
        with self._database.reading() as session:
            rows = repository.page(session, sought, limit + 1, before)
            shown = [FirstOutSummary.of(row) for row in rows[:limit]]
        following = shown[-1].id if len(rows) > limit else None
        return FirstOutPage(first_outs=shown, next=following, trouble=self._trouble())

    def detectors(self) -> list[str]:
        """Every detector that a first-out is of."""
        with self._database.reading() as session:
            return repository.detectors(session)

    def detail(self, number: int) -> FirstOutDetail | Refusal:
        """A first-out with everything that was kept of it."""
        with self._database.reading() as session:
            row = repository.get(session, number)
            return _unknown(number) if row is None else FirstOutDetail.of(row)

    def account(self, number: int) -> Account | Refusal:
        """What was kept of a first-out besides its samples."""
        with self._database.reading() as session:
            row = repository.get(session, number)
            return _unknown(number) if row is None else Account.model_validate(row.account)

    def samples(self, number: int) -> files.BoxSamples | Refusal:
        """Every tick that was kept."""
        samples = files.samples_of(self._folder, number)
        return samples if samples is not None else _no_samples(number)

    def window(
        self, number: int, channels: Sequence[str], from_s: float, to_s: float | None, points: int
    ) -> RunSamples | Refusal:
        """Minimum and maximum of channels in at most `points` stretches; times from the first-out."""
        names = known_channels(channels)
        if isinstance(names, Refusal):
            return names
        account = self.account(number)
        if isinstance(account, Refusal):
            return account
        samples = self.samples(number)
        if isinstance(samples, Refusal):
            return samples
        period_s = account.period_ns * 1e-9
        return window_of(samples, names, account.tick, period_s, from_s, to_s, points)

    def parquet(self, number: int) -> Path | Refusal:
        """The file of a first-out."""
        account = self.account(number)
        if isinstance(account, Refusal):
            return account
        path = files.box_path(self._folder, number)
        return path if account.ticks and path.exists() else _no_samples(number)

    def annotate(self, number: int, noted: FirstOutNote) -> FirstOutDetail | Refusal:
        """Note something about a first-out, or its cause."""
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is None:
                return _unknown(number)
            before = _noted(row)
            row.note = row.note if noted.note is None else noted.note
            row.cause = row.cause if noted.cause is None else noted.cause
            if _noted(row) != before:
                target = f"first-out {number}"
                record(session, Entry("first_outs.note", target, None, before, _noted(row)))
            session.flush()
            return FirstOutDetail.of(row)

    def remove(self, number: int) -> Refusal | None:
        """Remove a first-out with its samples."""
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is None:
                return _unknown(number)
            told = FirstOutSummary.of(row).model_dump(mode="json")
            record(session, Entry("first_outs.remove", f"first-out {number}", None, told, None))
            session.delete(row)
        files.take_out(self._folder, number)
        return None


def _noted(row: FirstOut) -> dict[str, str]:
    return {"note": row.note, "cause": row.cause}


def _unknown(number: int) -> Refusal:
    return Refusal(Code.UNKNOWN_FIRST_OUT, f"There is no first-out {number}")


def _no_samples(number: int) -> Refusal:
    detail = f"First-out {number} has no samples: the ring held nothing of it any more"
    return Refusal(Code.NO_DATA, detail)
