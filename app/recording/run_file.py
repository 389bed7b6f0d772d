"""The recording of one run under way: appended to by the recorder, part after part."""

from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from app.link.events import LoopEvent
from app.recording.extent import Extent, extent_of
from app.recording.live_overview import LiveOverview
from app.recording.outcome import Ending, Outcome, ending_of, last_tick_by_events
from app.recording.parts import PartWriter

STOPPED_BECAUSE = "stopped-because.txt"  # in a run's folder, until the run is in the book


class Recorded(NamedTuple):
    """What there is of a run that has ended; -1 for the ticks of one that has none."""

    first_tick: int
    last_tick: int
    ticks: int
    missing_ticks: int


@dataclass
class RunFile:
    """Where the ticks of one run go, and what the loop reported of it."""

    run_id: int
    folder: Path
    began_at: int  # its first tick, recorded or not
    extent: Extent
    left_at: int | None = None  # a tick that is not of this run any more
    missing_ticks: int = 0  # so far
    events: list[LoopEvent] = field(default_factory=list)
    _part: PartWriter | None = None
    _overview: LiveOverview | None = None
    _because: str = ""

    @staticmethod
    def open(run_id: int, runs_dir: Path, began_at: int) -> "RunFile":
        """Go on with what is on disk of this run already."""
        folder = runs_dir / str(run_id)
        extent = extent_of(folder)
        file = RunFile(run_id, folder, began_at, extent)
        file.missing_ticks = file.next_tick - began_at - extent.ticks
        return file

    @property
    def next_tick(self) -> int:
        """The tick with which the recording goes on."""
        return self.extent.last_tick + 1 if self.extent.ticks else self.began_at

    @property
    def size_bytes(self) -> int:
        """Bytes of the present part."""
        return self._part.size_bytes if self._part is not None else 0

    def append(self, records: npt.NDArray[Any]) -> LoopEvent | None:
        """Append (n,) TELEMETRY; ticks that are recorded already are left out.

        Returns the gap before them, where there is one. Raises `OSError` where the disk does not
        take them: then nothing counts as appended.
        """
        fresh = records[int(np.searchsorted(records["tick"], self.next_tick)) :]
        if len(fresh) == 0:
            return None
        if self._part is None:
            self._part = PartWriter(self.folder)
        self._part.append(fresh)
        self._see(fresh)
        missing = int(fresh["tick"][0]) - self.next_tick
        gap = _gap(self.next_tick, missing, float(fresh["time_s"][0])) if missing else None
        self.missing_ticks += missing
        self.extent = self.extent.grown_by(fresh["tick"])
        return gap

    def _see(self, records: npt.NDArray[Any]) -> None:
        if self._overview is None:
            self._overview = LiveOverview(self.folder)
        self._overview.add(records)

    def owns(self, event: LoopEvent) -> bool:
        """Whether an event is of this run, the tick in which the loop left it included."""
        return self.began_at <= event.tick and (self.left_at is None or event.tick <= self.left_at)

    def recorded(self, tail_ticks: int) -> Recorded:
        """What there is of it now that it has ended."""
        last = self.next_tick - 1
        if self.left_at is not None and self.left_at > self.next_tick:
            last = max(last, last_tick_by_events(self.events, self.left_at, tail_ticks))
        if last < self.began_at:
            return Recorded(-1, -1, 0, 0)
        missing = last - self.began_at + 1 - self.extent.ticks
        return Recorded(self.began_at, last, self.extent.ticks, missing)

    def stopped_because(self, reason: str) -> None:
        """The console itself stops this run, and why: kept beside the samples too. Raises `OSError`."""
        self._because = reason
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / STOPPED_BECAUSE).write_text(reason)

    def ending(self) -> Ending:
        """How it ended, by its events; of a stop that the console gave, with its reason."""
        ending = ending_of(self.events)
        if ending.outcome is not Outcome.STOPPED:
            return ending
        return Ending(ending.outcome, self._because or self._kept_reason() or ending.reason)

    def _kept_reason(self) -> str:
        try:
            return (self.folder / STOPPED_BECAUSE).read_text()
        except OSError:
            return ""

    def abandon_part(self) -> None:
        """Begin a new part with the next records: the present one may be torn, or is done."""
        part, self._part = self._part, None
        if part is not None:
            with suppress(OSError):
                part.close()

    def sync(self) -> None:
        """Bring what was appended to the disk itself. Raises `OSError`."""
        part = self._part
        if part is not None:
            part.sync()


def _gap(tick: int, ticks: int, time_s: float) -> LoopEvent:
    """The mark of ticks that are missing; its negative sequence is none of the loop's."""
    text = f"{ticks:,} ticks were not recorded"
    return LoopEvent(-max(tick, 1), tick, time_s, "gap", "gap", text, float(ticks), 0.0)
