"""What a run amounts to: its measurements, held against the test's acceptance criteria."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from app.analysis.acceptance import Verdict, judge, overall
from app.analysis.evidence import gather
from app.analysis.measurements import MEASUREMENTS, measure_all
from app.definitions.definition import Criterion, Definition
from app.definitions.windows import windows

NEEDS_REFERENCE = "goodness_of_fit"


@dataclass(frozen=True)
class Judgement:
    """One criterion with the value that was measured and what it amounts to."""

    measurement: str
    unit: str
    value: float | None
    at_least: float | None
    at_most: float | None
    outcome: Verdict


@dataclass(frozen=True)
class Judged:
    """All measurements of a run by name, every criterion of its test, and the verdict."""

    measurements: Mapping[str, float | None]
    criteria: tuple[Judgement, ...]
    verdict: Verdict


def needs_reference(definition: Definition) -> bool:
    """Whether a criterion compares with a reference run."""
    return any(c.measurement == NEEDS_REFERENCE for c in definition.acceptance)


def judge_run(
    definition: Definition,
    records: npt.NDArray[Any],
    period_s: float,
    valve_limit: float = 1.0,
    reference: npt.NDArray[Any] | None = None,
) -> Judged:
    """Measure and judge all ticks of a run, (n,) TELEMETRY; the same of a reference run, if any."""
    found = windows(definition, len(records))
    measured = measure_all(gather(records, found, period_s, valve_limit, reference))
    criteria = _judge_each(definition.acceptance, measured)
    return Judged(measured, criteria, overall(criterion.outcome for criterion in criteria))


def _judge_each(
    criteria: Iterable[Criterion], values: Mapping[str, float | None]
) -> tuple[Judgement, ...]:
    return tuple(
        Judgement(
            c.measurement,
            MEASUREMENTS[c.measurement].unit,
            values[c.measurement],
            c.at_least,
            c.at_most,
            judge(values[c.measurement], c.at_least, c.at_most),
        )
        for c in criteria
    )
