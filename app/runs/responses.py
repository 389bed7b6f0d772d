"""The frequency responses of runs: so far, of one under way; kept in its folder, of one that is over."""

import logging
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from typing import Any, Protocol

from app.analysis.response.transfers import EVERY
from app.conducting.found import Found
from app.conducting.responding import NEEDS, Responding, responds, responses_in
from app.db import Database
from app.definitions.definition import Definition
from app.definitions.responses import FrequencyResponse
from app.errors import Code, Refusal
from app.histories.history import Histories
from app.jobs.jobs import Job, Jobs, JobState
from app.prediction.schemas import Computing
from app.recording.samples import open_samples
from app.runs import repository
from app.runs.measuring import Subject, read_definition, read_rig
from app.runs.no_data import no_data
from app.runs.response_file import read_points, write_points
from app.runs.response_loop import (
    LOOP,
    available_of,
    loop_margins,
    loop_points,
    without_extremes,
)
from app.runs.response_model import Loop, ModelCurves, loads_of, position_curve
from app.runs.response_schemas import (
    ModelCurve,
    ResponseOut,
    ResponseProgress,
    ResponseSeries,
    TransferName,
)
from app.runs.response_series import bands_of, series_of

_log = logging.getLogger(__name__)
MODEL_WAIT_S = 1.0


class SoFar(Protocol):
    """Whoever follows the run under way."""

    def points(self, run_id: int) -> list[Found]: ...

    def progress(self, run_id: int) -> tuple[int, int, float | None] | None: ...


@dataclass(frozen=True)
class _Run:
    """What has to be known of a run."""

    subject: Subject
    under_way: bool
    made_with: dict[str, Any]
    definition: Definition
    asked: Sequence[FrequencyResponse]
    responds: bool
    no_data: Refusal


class Responses:
    """The responses of each run of this data directory. May be asked from any thread."""

    def __init__(
        self, database: Database, runs_dir: Path, so_far: SoFar, histories: Histories | None = None
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._so_far = so_far
        self._histories = histories
        self._models = ModelCurves()
        self._jobs: Jobs[None] = Jobs("frequency-responses")
        self._of_run: dict[int, Job[None]] = {}
        self._lock = Lock()

    def of(
        self,
        run_id: int,
        transfer: TransferName = "force",
        wait_s: float = 30.0,
        load_hz: float | None = None,
    ) -> ResponseOut | Computing | Refusal:
        """A transfer of a run; how far it is where its points take longer than `wait_s` to be found again.

        `load_hz` puts the compensation into the open loop, as it is under a load of that frequency.
        """
        run = self._run(run_id)
        if isinstance(run, Refusal):
            return run
        points = self._so_far.points(run_id) if run.under_way else self._kept(run_id, run, wait_s)
        if isinstance(points, Computing | Refusal):
            return points
        there = points
        if transfer == LOOP:
            controller = run.made_with["controller"]
            period_s = run.subject.period_s
            there = loop_points(points, run.definition, controller, period_s, load_hz)
        series = series_of(there, transfer)
        return ResponseOut(
            transfer=transfer,
            unit=EVERY[transfer].unit,
            available=available_of(points),
            series=without_extremes(series) if transfer == LOOP else series,
            model=self._model(run, transfer, series, load_hz),
            bands=bands_of(run.asked) if transfer == "force" else [],
            margins=loop_margins(series) if transfer == LOOP else [],
            progress=self._progress(run_id) if run.under_way else None,
        )

    def close(self) -> None:
        """Give up what is being computed."""
        self._jobs.close()
        self._models.close()

    def _progress(self, run_id: int) -> ResponseProgress | None:
        found = self._so_far.progress(run_id)
        if found is None:
            return None
        points, of, seconds_left = found
        return ResponseProgress(points=points, of=of, seconds_left=seconds_left)

    def _model(
        self,
        run: _Run,
        transfer: TransferName,
        series: Iterable[ResponseSeries],
        load_hz: float | None,
    ) -> list[ModelCurve]:
        loads = loads_of(series)
        if transfer in ("force", LOOP):
            loop = Loop(load_hz) if transfer == LOOP else None
            period_s = run.subject.period_s
            return self._models.of(run.made_with, loads, period_s, MODEL_WAIT_S, loop)
        if transfer == "position":
            curves = (position_curve(run.made_with, load) for load in loads)
            return [curve for curve in curves if curve is not None]
        return []

    def _kept(self, run_id: int, run: _Run, wait_s: float) -> list[Found] | Computing | Refusal:
        folder = run.subject.folder
        found = read_points(folder)
        if found is not None or not run.responds:
            return found or []
        if open_samples(folder) is None:
            return run.no_data
        job = self._job(run_id, run.subject)
        if isinstance(job, Refusal):
            return job
        if not job.ended.wait(wait_s):
            return Computing(share=job.share, seconds_left=job.seconds_left)
        found = read_points(folder) if job.state is JobState.DONE else None
        if found is None:
            _log.warning("frequency response of run %d: %s", run_id, job.reason)
            sentence = f"The frequency response of run {run_id} was not found"
            return job.why_not(sentence, Code.NO_DATA)
        return found

    def _job(self, run_id: int, subject: Subject) -> Job[None] | Refusal:
        """The computation of a run: that which is under way, or a new one."""
        with self._lock:
            job = self._of_run.get(run_id)
            if job is not None and not job.ended.is_set():
                return job
            title = f"Frequency response of run {run_id}"
            found = self._jobs.start(title, find_points, subject, self._histories)
            if isinstance(found, Job):
                self._of_run = {n: j for n, j in self._of_run.items() if not j.ended.is_set()}
                self._of_run[run_id] = found
            return found

    def _run(self, run_id: int) -> _Run | Refusal:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
            subject = Subject(
                folder=self._runs_dir / str(run_id),
                definition=run.definition,
                controller=run.controller,
                period_s=run.period_ns * 1e-9,
                first_tick=run.first_tick,
                completed=False,
                rig=run.rig,
            )
            made_with = {"rig": run.rig, "controller": run.controller}
            under_way, without = run.outcome is None, no_data(run)
        try:
            definition = read_definition(subject.definition, self._histories)
        except ValueError as error:
            return Refusal(Code.NO_DATA, f"Run {run_id}: {error}")
        asked = responses_in(definition)
        return _Run(subject, under_way, made_with, definition, asked, responds(definition), without)


def find_points(report: Any, subject: Subject, histories: Histories | None) -> None:
    """Find the points of a run that is over and keep them in its folder, as the measuring does."""
    samples = open_samples(subject.folder)
    if samples is None:
        raise ValueError("there are no samples of the run")
    first_tick = samples.first_tick if subject.first_tick is None else subject.first_tick
    definition = read_definition(subject.definition, histories)
    rig = read_rig(subject.rig)
    responding = Responding(definition, subject.period_s, first_tick, rig)
    ticks = max(1, samples.last_tick - samples.first_tick + 1)
    for chunk in samples.chunks(NEEDS, samples.first_tick, samples.last_tick):
        responding.take(chunk)
        if len(chunk["tick"]):
            report((int(chunk["tick"][-1]) - samples.first_tick + 1) / ticks)
    write_points(subject.folder, responding.points())
