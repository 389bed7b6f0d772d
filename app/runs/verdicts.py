"""What was measured and judged of a run, as rows of the tables."""

import math
from collections.abc import Iterable
from typing import Any

from app.analysis.acceptance import overall
from app.analysis.measurements import MEASUREMENTS
from app.prediction.judgement import Judged, Judgement

WHOLE_RUN = -1
Row = dict[str, Any]


def measurement_rows(run_id: int, judged: Judged) -> list[Row]:
    """A row for each value, of the run and of its blocks, and for each that a criterion asks for."""
    asked: dict[tuple[int, str], list[Judgement]] = {}
    for one in judged.criteria:
        block = WHOLE_RUN if one.block is None else one.block
        asked.setdefault((block, one.measurement), []).append(one)
    found = {
        (block, name): value
        for block, values in {WHOLE_RUN: judged.measured.run, **judged.measured.blocks}.items()
        for name, value in values.items()
        if value is not None
    }
    keys = dict.fromkeys([*found, *asked])
    return [
        {
            "run_id": run_id,
            "block": block,
            "name": name,
            "unit": MEASUREMENTS[name].unit,
            "value": finite(found.get((block, name))),
            **_limits(asked.get((block, name), [])),
        }
        for block, name in keys
    ]


def criterion_rows(run_id: int, judged: Judged) -> list[Row]:
    """A row for each criterion, in the order of the definition."""
    return [
        {
            "run_id": run_id,
            "position": position,
            "measurement": one.measurement,
            "block": one.block,
            "unit": one.unit,
            "value": finite(one.value),
            "at_least": one.at_least,
            "at_most": one.at_most,
            "outcome": one.outcome.value,
        }
        for position, one in enumerate(judged.criteria)
    ]


def finite(value: float | None) -> float | None:
    """Neither JSON nor every database has a NaN: None, as for what was not measured."""
    return value if value is not None and math.isfinite(value) else None


def _limits(criteria: Iterable[Judgement]) -> Row:
    """The tightest limits of criteria on the same value, and the worst outcome."""
    asked = list(criteria)
    lows = [c.at_least for c in asked if c.at_least is not None]
    highs = [c.at_most for c in asked if c.at_most is not None]
    return {
        "at_least": max(lows, default=None),
        "at_most": min(highs, default=None),
        "outcome": overall(c.outcome for c in asked).value if asked else None,
    }
