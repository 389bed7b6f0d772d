"""Comparisons of runs: short ones at once, long ones in a process apart."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

from app.analysis.measurements import MEASUREMENTS
from app.analysis.trend import trend
from app.comparison import repository
from app.comparison.measured import Measured, measurement_rows
from app.comparison.order import Asked, Side
from app.comparison.overlays import Overlays
from app.comparison.schemas import (
    Align,
    ComparedRun,
    OverlayOut,
    RunComparison,
    Trend,
    TrendLine,
    TrendPoint,
)
from app.comparison.settings import MOST_ROWS, Part, differing
from app.db import Database
from app.errors import Code, Fault, Refusal
from app.histories.history import Histories
from app.prediction.schemas import Computing
from app.runs import repository as runs_repository
from app.runs.models import Run, RunMeasurement
from app.runs.no_data import no_data
from app.runs.samples import known_channels
from app.runs.verdicts import WHOLE_RUN
from rtcore.channels import CHANNEL

LEAST_RUNS, MOST_RUNS = 2, 8
DAY_S = 86_400.0


@dataclass(frozen=True)
class _Known:
    """What the book says of a run."""

    side: Side
    told: ComparedRun
    measured: Measured
    settings: dict[str, Any]


class Comparisons:
    """Compares the runs of this data directory. May be asked from any thread."""

    def __init__(
        self, database: Database, runs_dir: Path, histories: Histories | None = None
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._overlays = Overlays(histories)

    def of(self, asked: Asked, wait_s: float = 0.0) -> RunComparison | Computing | Refusal:
        """Runs beside one another; how far that is where it takes longer than `wait_s`."""
        refusal = _refused(asked)
        runs = refusal or self._known(asked.ids)
        if isinstance(runs, Refusal):
            return runs
        different = _other_period(runs)
        if different is not None and asked.align is not Align.PHASE:
            return different
        laid = self._overlays.of(asked, [run.side for run in runs], wait_s)
        if not isinstance(laid, OverlayOut):
            return laid
        settings = differing([run.settings for run in runs])
        offsets = zip(runs, laid.offsets_s, strict=True)
        return RunComparison(
            baseline_id=asked.ids[0],
            runs=[run.told.model_copy(update={"offset_s": offset}) for run, offset in offsets],
            overlay=laid,
            measurements=measurement_rows(
                [run.measured for run in runs],
                asked.tolerance,
                {CHANNEL[name].unit for name in asked.channels},
            ),
            settings=settings[:MOST_ROWS],
            settings_in_all=len(settings),
        )

    def trend(
        self, measurement: str, test_id: str, block: int | None = None, limit: int = 200
    ) -> Trend | Refusal:
        """A measurement over the newest runs of a test, oldest first, and the line through it."""
        known = MEASUREMENTS.get(measurement)
        if known is None:
            fault = Fault("query.measurement", measurement, f"one of {', '.join(MEASUREMENTS)}")
            detail = f"Unknown measurement: {measurement}"
            return Refusal(Code.INVALID_REQUEST, detail, (fault,))
        of = (test_id, measurement, WHOLE_RUN if block is None else block)
        with self._database.reading() as session:
            rows = repository.values_over_runs(session, *of, limit)
            count = repository.count_values(session, *of)
        points = [_trend_point(row) for row in rows]
        values = [point.value for point in points]
        days = [(p.started_at - points[0].started_at).total_seconds() / DAY_S for p in points]
        line = trend(days, values)
        return Trend(
            measurement=measurement,
            unit=known.unit,
            test_id=test_id,
            block=block,
            points=points,
            runs_in_all=count,
            mean=sum(values) / len(values) if values else None,
            line=None if line is None else TrendLine.model_validate(line),
        )

    def close(self) -> None:
        """Give up what is being computed."""
        self._overlays.close()

    def _known(self, ids: Sequence[int]) -> list[_Known] | Refusal:
        found = []
        with self._database.reading() as session:
            for run_id in ids:
                run = runs_repository.get(session, run_id)
                if run is None:
                    return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
                refusal = self._unfit(run)
                if refusal is not None:
                    return refusal
                found.append(self._read(run, runs_repository.measurements(session, run_id)))
        return found

    def _unfit(self, run: Run) -> Refusal | None:
        if run.outcome is None:
            detail = f"Run {run.id} is still under way: compare it once it is over"
            return Refusal(Code.RUN_UNDER_WAY, detail)
        if run.ticks == 0 or run.samples_removed_at is not None:
            none = no_data(run)
            return Refusal(none.code, f"{none.detail}: leave it out of the comparison")
        return None

    def _read(self, run: Run, rows: Sequence[RunMeasurement]) -> _Known:
        side = Side(
            run_id=run.id,
            folder=self._runs_dir / str(run.id),
            definition=run.definition,
            period_s=run.period_ns * 1e-9,
            first_tick=run.first_tick,
        )
        names = ComparedRun.model_fields.keys() - {"offset_s"}
        told = {name: getattr(run, name) for name in names}
        settings: dict[str, Any] = {part: getattr(run, part) for part in get_args(Part)}
        values = {(row.block, row.name): row.value for row in rows}
        return _Known(side, ComparedRun(**told, offset_s=None), Measured(run.id, values), settings)


def _refused(asked: Asked) -> Refusal | None:
    """What of the request itself cannot be."""
    ids = asked.ids
    if not LEAST_RUNS <= len(ids) <= MOST_RUNS or len(set(ids)) < len(ids):
        expected = f"{LEAST_RUNS} to {MOST_RUNS} different runs, the baseline first"
        fault = Fault("query.ids", json.dumps(ids), expected)
        return Refusal(Code.INVALID_REQUEST, f"Choose {expected}", (fault,))
    channels = known_channels(asked.channels)
    if isinstance(channels, Refusal):
        return channels
    if asked.align is Align.BLOCK and asked.block is None:
        fault = Fault("query.block", None, "the number of a block, from 0")
        return Refusal(Code.INVALID_REQUEST, "Say which block to align by", (fault,))
    return None


def _other_period(runs: Sequence[_Known]) -> Refusal | None:
    baseline = runs[0].side
    for run in runs[1:]:
        if run.side.period_s != baseline.period_s:
            rates = [f"{1 / side.period_s:.6g} Hz" for side in (run.side, baseline)]
            detail = (
                f"Run {run.side.run_id} was recorded at {rates[0]} and run {baseline.run_id} at "
                f"{rates[1]}: their ticks cannot be compared; align them in phase"
            )
            return Refusal(Code.INVALID_REQUEST, detail)
    return None


def _trend_point(row: Any) -> TrendPoint:
    run_id, started_at, revision, outcome, value, at_least, at_most = row
    return TrendPoint(
        run_id=run_id,
        started_at=started_at,
        revision=revision,
        outcome=outcome,
        value=value,
        at_least=at_least,
        at_most=at_most,
    )
