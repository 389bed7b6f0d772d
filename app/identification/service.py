"""Identifications: starting one, looking at them, giving up, and putting a fitted model in force."""

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from threading import Event, Lock

from pydantic import ValidationError

from app.access.principal import Principal
from app.authority.service import InCommand
from app.db import Database
from app.errors import Code, Fault, Refusal
from app.identification.book import Book
from app.identification.models import Identification, State
from app.identification.parameters import PARAMETERS, changed, read
from app.identification.queue import Queue
from app.identification.requests import (
    AdoptRequest,
    FittableParameter,
    IdentificationOut,
    IdentificationRequest,
    IdentificationSummary,
    detail,
    summary,
)
from app.identification.schemas import Fit, Identified
from app.identification.work import fit_to_runs
from app.jobs.apart import Report, run_apart
from app.revisions.kind import Wanted
from app.rig_configuration.service import RigConfigurations
from app.runs import repository as runs
from app.runs.no_data import no_data
from rtcore.rig.parameters import RigParameters

MOST_WAITING = 8
CRASHED = "The console ended in the middle of it: start it again"
_BUSY = Refusal(Code.BUSY, "Other identifications are waiting: try again once they are done")


class Identifications:
    """Fits the model in force to runs of this data directory."""

    def __init__(
        self,
        database: Database,
        runs_dir: Path,
        configurations: RigConfigurations,
        in_command: InCommand,
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._configurations = configurations
        self._in_command = in_command
        self._book = Book(database)
        self._queue = Queue(self._book)
        self._adopting = Lock()

    def open(self) -> None:
        """What an earlier start has left has no end."""
        self._book.interrupt_all(CRASHED)

    def close(self) -> None:
        """Give up what is under way."""
        self._queue.close()

    def parameters(self) -> list[FittableParameter]:
        """All that can be fitted, as they are in the model in force."""
        model = self._configurations.in_force.document.model
        return [
            FittableParameter(
                path=p.path, title=p.title, unit=p.unit, group=p.group, value=read(model, p.path)
            )
            for p in PARAMETERS
        ]

    def start(self, who: Principal, asked: IdentificationRequest) -> IdentificationOut | Refusal:
        """Enter an identification; it is worked on when all before it have ended."""
        period_s = self._period_s(asked.run_ids)
        if isinstance(period_s, Refusal):
            return period_s
        if len(self._queue) >= MOST_WAITING:
            return _BUSY
        configuration = self._configurations.in_force
        fit = Fit.model_validate(asked.model_dump(exclude={"run_ids"}))
        row = Identification(
            state=State.WAITING,
            run_ids=list(asked.run_ids),
            fit=fit.model_dump(mode="json"),
            based_on=configuration.number,
            model=configuration.document.model.model_dump(mode="json"),
            author=who.name[:200],
            created_at=datetime.now(UTC),
        )
        model = dict(row.model)
        folders = [(n, self._runs_dir / str(n)) for n in asked.run_ids]

        def work(report: Report, unwanted: Event) -> Identified | Refusal:
            asked_of = fit_to_runs, folders, model, fit, period_s
            return run_apart(*asked_of, report=report, unwanted=unwanted)

        number = self._book.enter(row)
        self._queue.put(number, work)
        return self.detail(number)

    def page(self, limit: int, before: int | None) -> list[IdentificationSummary]:
        """The newest, or those before a number."""
        return [summary(row, *self._far(row)) for row in self._book.page(limit, before)]

    def detail(self, number: int) -> IdentificationOut | Refusal:
        """One with all that came of it."""
        row = self._book.get(number)
        return row if isinstance(row, Refusal) else detail(row, *self._far(row))

    def cancel(self, number: int) -> IdentificationOut | Refusal:
        """Give one up; one that has ended stays as it is."""
        self._queue.give_up(number)
        return self.detail(number)

    def remove(self, number: int) -> Refusal | None:
        """Forget one that has ended."""
        with self._adopting:
            return self._book.remove(number)

    def adopt(
        self, who: Principal, number: int, asked: AdoptRequest
    ) -> IdentificationOut | Refusal:
        """Put its model in force, as a revision of the rig configuration."""
        with self._adopting:
            refusal = self._adopt(who, number, asked)
        return refusal or self.detail(number)

    def _adopt(self, who: Principal, number: int, asked: AdoptRequest) -> Refusal | None:
        row = self._book.get(number)
        if isinstance(row, Refusal):
            return row
        now = self._configurations.in_force
        model = _adoptable(row, now.document.model)
        if isinstance(model, Refusal):
            return model
        lease = self._in_command(who, asked.lease)
        if isinstance(lease, Refusal):
            return lease
        document = now.document.model_copy(update={"model": model})
        made = self._configurations.change(
            Wanted(
                document,
                asked.why,
                now.number,
                who.name,
                lease,
                also=lambda session, made: self._book.adopted(session, number, made, asked.why),
            )
        )
        return made if isinstance(made, Refusal) else None

    def _period_s(self, run_ids: Sequence[int]) -> float | Refusal:
        """Of runs that are over and have samples, all at one rate."""
        if len(set(run_ids)) < len(run_ids):
            return _wrong(run_ids, "each run once")
        periods = set()
        with self._database.reading() as session:
            for run_id in run_ids:
                run = runs.get(session, run_id)
                if run is None:
                    return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
                if run.outcome is None:
                    late = f"Run {run_id} is under way: wait for its end"
                    return Refusal(Code.RUN_UNDER_WAY, late)
                if run.samples_removed_at is not None or not run.ticks:
                    return no_data(run)
                periods.add(run.period_ns * 1e-9)
        return periods.pop() if len(periods) == 1 else _wrong(run_ids, "runs of one loop rate")

    def _far(self, row: Identification) -> tuple[float, float | None]:
        turn = self._queue.turn(row.id)
        return (0.0, None) if turn is None else (turn.share, turn.seconds_left)


def _adoptable(row: Identification, now: RigParameters) -> RigParameters | Refusal:
    """The model in force with what was found in its place, where that is still what was begun with."""
    if row.result is None:
        return Refusal(Code.NO_DATA, f"Identification {row.id} has found nothing to adopt")
    if row.adopted_revision is not None:
        told = f"Identification {row.id} is revision {row.adopted_revision} already"
        return Refusal(Code.EDIT_CONFLICT, told)
    if now != RigParameters.model_validate(row.model):
        told = (
            f"The model in force is not that of revision {row.based_on} any more, from which"
            f" identification {row.id} began: identify again"
        )
        return Refusal(Code.EDIT_CONFLICT, told)
    values = Identified.model_validate(row.result).values()
    if not values:
        return Refusal(Code.NO_DATA, "The runs tell none of these parameters: nothing to adopt")
    try:
        return changed(now, values)
    except ValidationError as error:
        return Refusal(Code.INVALID_REQUEST, f"This rig cannot be simulated: {error}")


def _wrong(run_ids: Sequence[int], expected: str) -> Refusal:
    fault = Fault("body.run_ids", list(run_ids), expected)
    return Refusal(Code.INVALID_REQUEST, f"run_ids: must be {expected}", (fault,))
