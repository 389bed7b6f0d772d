"""The rig now, and at recorded moments."""

import math
from collections.abc import Mapping
from typing import Any

from app.db import Database
from app.definitions.limits import RIG
from app.errors import Code, Refusal
from app.link.life import Life
from app.rig_configuration.record import model_of
from app.runs import repository
from app.runs.samples import RunWindows
from app.scene.chain import Chain, Reading
from app.scene.telling import Moment


def reading_now(life: Life | None) -> Reading:
    """What the loop has published last; nothing is known of a loop that is silent."""
    record = life.snapshot() if life is not None and life.alive else None
    return (
        Reading() if record is None else _reading({name: record[name] for name in Reading._fields})
    )


def _reading(values: Mapping[str, Any]) -> Reading:
    known = {name: None if value is None else float(value) for name, value in values.items()}
    return Reading(**{n: v if v is None or math.isfinite(v) else None for n, v in known.items()})


class Moments:
    """Of the runs of this data directory, with the rig as it was then."""

    def __init__(self, database: Database, windows: RunWindows) -> None:
        self._database = database
        self._windows = windows

    def at(self, run_id: int, time_s: float) -> Moment | Refusal:
        """The tick next to a time (s) from the run's first tick."""
        tick_s = round(time_s / RIG.period_s) * RIG.period_s
        found = self._windows.window(run_id, Reading._fields, tick_s, tick_s, 1)
        if isinstance(found, Refusal):
            return found
        if not found.time_s:
            return Refusal(Code.NO_DATA, f"Run {run_id} has no sample at {time_s:g} s")
        values = {name: band.min[0] for name, band in found.channels.items()}
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            rig = {} if run is None else dict(run.rig)
        return Moment(Chain.of(model_of(rig)), _reading(values))
