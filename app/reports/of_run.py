"""What a report needs of a run of the console: from its database and the run's folder alone."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

from app.analysis.walk import HOLD_FADE_S
from app.db import Database
from app.errors import Code, Refusal
from app.histories.history import Histories
from app.prediction.schemas import Prediction
from app.prediction.series_file import NAME as PREDICTED
from app.recording.files import parquet_path
from app.recording.samples import Samples, open_samples
from app.reports.found import Found
from app.reports.subject import Frozen, Happening, Noted, Subject
from app.run_analysis.computing import Subject as Analysed
from app.run_analysis.computing import analyse_run, analysis_of, kept
from app.run_analysis.schemas import RunAnalysis
from app.runs import repository
from app.runs.measuring import read_definition
from app.runs.models import Run, RunEvent
from app.runs.no_data import no_data
from app.runs.predicted import PredictedSamples, passages
from app.runs.results import Results
from app.runs.schemas import RunEventOut


def subject_of_run(
    run_id: int, database: Database, runs_dir: Path, histories: Histories | None = None
) -> Subject | Refusal:
    """A run that is over; one under way is refused."""
    measured = Results(database, runs_dir, None).measurements(run_id)
    if isinstance(measured, Refusal):
        return measured
    with database.reading() as session:
        run = repository.get(session, run_id)
        if run is None:
            return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
        if run.outcome is None:
            return under_way(run_id)
        events = repository.events(session, run_id)
        folder = runs_dir / str(run_id)
        period_s = run.period_ns * 1e-9
        samples = open_samples(folder)
        return Subject(
            label=f"Run {run_id}",
            test_id=run.test_id,
            test_name=run.test_name,
            revision=run.revision,
            frozen=_frozen(run),
            measured=measured,
            outcome=run.outcome,
            reason=run.reason,
            period_s=period_s,
            ticks=run.ticks,
            missing_ticks=run.missing_ticks,
            software=run.software_version,
            events=tuple(_happening(event, run) for event in events),
            noted=Noted(run.operator, run.notes, tuple(run.tags), run.override_reason),
            started_at=run.started_at,
            ended_at=run.ended_at,
            first_tick=run.first_tick,
            prediction=Prediction(**run.prediction) if run.prediction else None,
            samples=samples,
            found=None if samples is None else _found(run, samples, folder, histories),
            predicted=_predicted(folder, run, events),
            data_file=parquet_path(folder),
            without_samples=no_data(run).detail,
        )


def under_way(run_id: int) -> Refusal:
    """There is nothing to report yet."""
    detail = f"Run {run_id} is still under way: a report can be made once it has ended"
    return Refusal(Code.RUN_UNDER_WAY, detail)


def _frozen(run: Run) -> Frozen:
    return Frozen(run.definition, run.controller, run.interlocks, run.rig, run.conditions)


def _happening(event: RunEvent, run: Run) -> Happening:
    told = RunEventOut.of(event, run)
    return Happening(told.time_s, told.kind, told.code, told.text, told.value, told.limit)


def _found(run: Run, samples: Samples, folder: Path, histories: Histories | None) -> Found | None:
    """None where its definition is of a version that cannot be read any more."""
    try:
        definition = read_definition(run.definition, histories)
    except ValueError:
        return None
    first_tick = samples.first_tick if run.first_tick is None else run.first_tick
    period_s = run.period_ns * 1e-9
    made_with = definition, run.rig, run.controller
    told = run.definition, run.rig, period_s, first_tick, histories
    analyse = partial(_analysed, Analysed(folder, *told))
    return Found(*made_with, samples, period_s, first_tick, analyse, folder)


def _analysed(subject: Analysed) -> RunAnalysis:
    """As the console keeps it, or would: the next to ask finds it there."""
    found = kept(subject.folder)
    if found is None:
        analyse_run(_ignore, subject)
        found = kept(subject.folder)
    # What has values that are no numbers is not understood when it is read back.
    return found or analysis_of(subject, _ignore)


def _ignore(share: float) -> None:
    """Nobody waits for that share alone."""


def _predicted(folder: Path, run: Run, events: Sequence[RunEvent]) -> Samples | None:
    path = folder / PREDICTED
    if not path.exists():
        return None
    ticks = max(run.ticks, pq.read_metadata(path).num_rows)
    fade = int(np.round(HOLD_FADE_S / (run.period_ns * 1e-9)))
    where = passages(events, run.first_tick or 0, ticks, fade)
    return PredictedSamples(path, where)
