"""A simulation told as plain data: for `--json`, and for the metadata of its file."""

import math
from typing import Any

from app.analysis.measurements import MEASUREMENTS
from app.definitions.limits import RIG
from app.documents.writing import to_data
from app.prediction.simulation import Simulating
from app.settings import VERSION


def account(simulating: Simulating) -> dict[str, Any]:
    """What came of it, in types that JSON knows."""
    through = simulating.through
    judged = through.judged
    return {
        "test": through.setup.definition.name,
        "outcome": through.ending.outcome.value,
        "reason": through.ending.reason,
        "verdict": judged.verdict.value,
        "ticks": through.ticks,
        "duration_s": through.ticks * RIG.period_s,
        "seed": through.setup.seed,
        "measurements": [
            {"name": name, "unit": MEASUREMENTS[name].unit, "value": _finite(value)}
            for name, value in judged.measurements.items()
        ],
        "acceptance": [
            {
                "measurement": c.measurement,
                "block": c.block,
                "unit": c.unit,
                "value": _finite(c.value),
                "at_least": c.at_least,
                "at_most": c.at_most,
                "outcome": c.outcome.value,
            }
            for c in judged.criteria
        ],
        "events": [
            {"tick": e.tick, "time_s": e.time_s, "kind": e.kind, "code": e.code, "text": e.text}
            for e in through.events
        ],
        "prediction": simulating.prediction().model_dump(mode="json"),
    }


def metadata(simulating: Simulating) -> dict[str, Any]:
    """What its file is to remember: everything that it was made with, and what came of it."""
    setup = simulating.through.setup
    return {
        "clock": "virtual",
        "test_name": setup.definition.name,
        "definition": to_data(setup.definition),
        "controller": to_data(setup.controller),
        "interlocks": to_data(setup.interlocks),
        "rig": setup.rig.model_dump(mode="json"),
        "software_version": VERSION,
        "period_ns": round(RIG.period_s * 1e9),
        **account(simulating),
    }


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
