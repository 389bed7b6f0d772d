"""The points of a run's frequency responses in its folder: made when the run is measured, or when asked for."""

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from app.analysis.response.point import Interval, ResponsePoint
from app.conducting.found import Found
from app.recording.whole_file import whole_file

NAME = "frequency-response.json"
VERSION = 4
_BEFORE = 3  # in which points at the end of a sweep were wrong, and no others


def write_points(folder: Path, points: Sequence[Found]) -> None:
    """Keep the points of a run. Raises `OSError`."""
    told = {"version": VERSION, "points": [_plain(found) for found in points]}
    with whole_file(folder / NAME) as file:
        file.write(json.dumps(told, allow_nan=False).encode())


def read_points(folder: Path) -> list[Found] | None:
    """The points in a run's folder; None where there are none that are understood."""
    try:
        told = json.loads((folder / NAME).read_bytes())
        found = [_found(one) for one in told["points"]]
        version = told["version"]
    except (FileNotFoundError, ValueError, KeyError, TypeError):
        return None
    right = version == VERSION or (version == _BEFORE and all(f.method != "sweep" for f in found))
    return found if right else None


def _plain(found: Found) -> dict[str, Any]:
    point = {name: _number(value) for name, value in found.point._asdict().items()}
    return {**found._asdict(), "point": point}


def _number(value: Any) -> Any:
    """JSON knows no infinity: null, as an end that has no bound."""
    if isinstance(value, tuple):
        return [_number(end) for end in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _found(told: dict[str, Any]) -> Found:
    point = told["point"]
    for name in ("gain_95", "phase_95_deg"):
        low, high = point[name]
        point[name] = Interval(
            -math.inf if low is None else low, math.inf if high is None else high
        )
    point = {
        name: math.nan if value is None and name in _NUMBERS else value
        for name, value in point.items()
    }
    return Found(**{**told, "point": ResponsePoint(**point)})


_NUMBERS = ("gain", "phase_deg")
