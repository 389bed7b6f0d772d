"""The table of detectors for the loop, from files, and its trips in words."""

from pathlib import Path
from typing import Any

import numpy as np

from app.documents.reading import read_data, read_file
from app.errors import Code, Refusal
from app.interlocks.table import Interlocks
from app.link.words import trip_text
from rtcore.interlocks import DETECTOR, INTERLOCKS, armed_in


def to_record(interlocks: Interlocks, period_s: float) -> Any:
    """The table as an INTERLOCKS record, () of dtype INTERLOCKS."""
    record = np.zeros((), INTERLOCKS)
    record["count"] = len(interlocks.detectors)
    for i, d in enumerate(interlocks.detectors):
        values = {
            "quantity": d.quantity,
            "form": d.form,
            "comparison": d.comparison,
            "action": d.action,
            "enabled": d.enabled,
            "latching": d.latching,
            "armed_modes": armed_in(*d.armed),
            "persistence_ticks": d.persistence_ticks(period_s),
            "threshold": d.threshold,
            "low": d.low or 0.0,
            "horizon_s": d.horizon_s or 0.0,
            "smoothing_s": d.smoothing_s or 0.0,
        }
        record["detectors"][i] = tuple(values[name] for name in DETECTOR.names or ())
    return record


def describe(interlocks: Interlocks, event: Any, period_s: float) -> str:
    """A trip (an EVENT record) in words: `Force error 16,200 N for 50 ms, limit 15,000 N`."""
    detector = to_record(interlocks, period_s)["detectors"][int(event["code"])]
    value, limit = float(event["value"]), float(event["limit"])
    return trip_text(detector, value, limit, round(period_s * 1e9))


def load_interlocks(path: Path) -> Interlocks | Refusal:
    """The detectors in a file: JSON where its name ends in .json, YAML otherwise."""
    return read_file(Interlocks, path, Code.INVALID_REQUEST)


def interlocks_from(data: Any, source: str = "interlocks") -> Interlocks | Refusal:
    """The detectors in plain data, as from a JSON request."""
    return read_data(Interlocks, data, Code.INVALID_REQUEST, source)
