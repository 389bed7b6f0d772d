"""The measurements of runs side by side."""

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from app.analysis.measurements import MEASUREMENTS
from app.analysis.overlay import Tolerance
from app.comparison.schemas import ComparedValue, MeasurementRow
from app.runs.verdicts import WHOLE_RUN


class Measured(NamedTuple):
    """What was measured of a run, by block (−1 is the run as a whole) and name."""

    run_id: int
    values: Mapping[tuple[int, str], float | None]


def measurement_rows(
    runs: Sequence[Measured], tolerance: Tolerance | None, units: Collection[str] = ()
) -> list[MeasurementRow]:
    """Whatever one of the runs has, the whole run's first.

    An absolute tolerance is one of the measurements in the `units` of the channels that it was given for.
    """
    keys = dict.fromkeys(key for run in runs for key in run.values)
    blocks = sorted({block for block, _ in keys})
    ordered = [(b, name) for b in blocks for name in MEASUREMENTS if (b, name) in keys]
    return [
        MeasurementRow(
            block=None if block == WHOLE_RUN else block,
            name=name,
            unit=MEASUREMENTS[name].unit,
            values=_values(
                runs, (block, name), _of_unit(tolerance, MEASUREMENTS[name].unit in units)
            ),
        )
        for block, name in ordered
    ]


def _of_unit(tolerance: Tolerance | None, absolute: bool) -> Tolerance | None:
    """What of a tolerance holds for a measurement; None where nothing does."""
    if tolerance is None or absolute:
        return tolerance
    return Tolerance(0.0, tolerance.relative) if tolerance.relative > 0 else None


def _values(
    runs: Sequence[Measured], key: tuple[int, str], tolerance: Tolerance | None
) -> list[ComparedValue]:
    values = [run.values.get(key) for run in runs]
    baseline, told = values[0], []
    for run, value in zip(runs, values, strict=True):
        difference = None if value is None or baseline is None else value - baseline
        within = None
        if difference is not None and baseline is not None and tolerance is not None:
            within = abs(difference) <= tolerance.at(baseline)
        told.append(
            ComparedValue(run_id=run.run_id, value=value, difference=difference, within=within)
        )
    return told
