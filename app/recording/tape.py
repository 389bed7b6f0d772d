"""The tape: the telemetry of one life of the loop, read once and split into its runs."""

import logging
from collections import deque
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from app.link.events import EventReader, LoopEvent
from app.link.life import Life
from app.recording.clerk import Clerk, OpenRun
from app.recording.extent import extent_of
from app.recording.outcome import LOOP_ENDED, Outcome
from app.recording.run_file import RunFile
from rtcore.supervise import RUN_TAIL_S

_log = logging.getLogger(__name__)
_BATCH_TICKS = 1 << 14


class Tape:
    """Follows one life of the loop. One thread drains it; a run that ends goes to the clerk."""

    def __init__(self, life: Life, runs_dir: Path, clerk: Clerk) -> None:
        self._life = life
        self._runs_dir = runs_dir
        self._clerk = clerk
        self._reader = life.telemetry()
        self._events = EventReader(life)
        self._waiting: deque[LoopEvent] = deque()  # of ticks that are not read yet
        self._leaving: list[RunFile] = []
        self._unseen: set[int] = set()  # left open, and not known whether they began
        self._new_from_tick = life.next_tick()
        self._tail_ticks = round(RUN_TAIL_S / (life.period_ns * 1e-9))
        self.current: RunFile | None = None
        self.trouble: str | None = None
        self._resume()

    def _resume(self) -> None:
        """Go on with the runs that an earlier app left open, where in the ring they go on."""
        starts = [self._new_from_tick]
        for run in self._clerk.open_runs(self._life.name):
            first_tick = self._first_tick(run)
            if first_tick is None:
                self._unseen.add(run.id)
                starts.append(0)
                continue
            self._leave(first_tick)
            self.current = RunFile.open(run.id, self._runs_dir, first_tick)
            starts.append(self.current.next_tick)
        self._filed_to = min(starts) - 1
        self._reader.position = self._life.position_of(min(starts))

    def _first_tick(self, run: OpenRun) -> int | None:
        """Where a run began, by the book or by its samples; None where it is not known whether it did.

        The samples come first: of a run that began while the clerk was busy the book knows nothing yet.
        """
        if run.first_tick is not None:
            return run.first_tick
        extent = extent_of(self._runs_dir / str(run.id))
        if extent.ticks == 0:
            return None
        self._clerk.began(run.id, extent.first_tick)
        return extent.first_tick

    def drain(self) -> None:
        """Read and file everything that has been published."""
        for records in self._records():
            if not self._file(records):
                break
            self._filed_to = int(records["tick"][-1])
            self._life.has_recorded(self._life.position_of(self._filed_to + 1))
        self._waiting.extend(self._events.read())
        self._assign_events(self._filed_to)
        self._hand_over()

    def finish(self) -> None:
        """The loop is dead and all that it published has been drained: end what is still open."""
        self._assign_events(np.iinfo(np.int64).max)
        file, self.current = self.current, None
        if file is not None:
            file.abandon_part()
            ending = file.ending()
            tripped = ending.outcome is Outcome.TRIPPED
            recorded = file.recorded(self._tail_ticks)
            self._clerk.ended(file.run_id, recorded, ending if tripped else LOOP_ENDED)
        for run in self._clerk.open_runs(self._life.name):
            self._clerk.never_began(run.id)

    def end_unseen(self) -> None:
        """After the first drain: a run left open of which no tick was found never began."""
        for run_id in sorted(self._unseen):
            self._clerk.never_began(run_id)
        self._unseen.clear()

    def _records(self) -> Iterator[npt.NDArray[Any]]:
        """What is published, in stretches of one run each."""
        caught_up = False
        while not caught_up:
            records = self._reader.read(_BATCH_TICKS).records
            caught_up = len(records) < _BATCH_TICKS
            edges = np.flatnonzero(np.diff(records["run"])) + 1
            yield from (part for part in np.split(records, edges) if len(part))

    def _file(self, records: npt.NDArray[Any]) -> bool:
        """File a stretch of one run; False where the disk does not take it: it is read again."""
        run_id, tick = int(records["run"][0]), int(records["tick"][0])
        if self.current is not None and self.current.run_id != run_id:
            self._leave(tick)
        if run_id == 0 or not self._is_wanted(run_id, tick):
            return True
        if self.current is None:
            self._clerk.began(run_id, tick)
            self.current = RunFile.open(run_id, self._runs_dir, tick)
        return self._append(self.current, records)

    def _is_wanted(self, run_id: int, tick: int) -> bool:
        """Whether it is new, or of a run left open; what was finished before is passed over."""
        is_current = self.current is not None and self.current.run_id == run_id
        return is_current or run_id in self._unseen or tick >= self._new_from_tick

    def _append(self, file: RunFile, records: npt.NDArray[Any]) -> bool:
        try:
            gap = file.append(records)
        except OSError as error:
            if self.trouble is None:
                _log.error("run %d: the disk does not take the samples: %s", file.run_id, error)
            self.trouble = error.strerror or str(error)
            file.abandon_part()
            self._reader.position = self._life.position_of(int(records["tick"][0]))
            return False
        self.trouble = None
        self._unseen.discard(file.run_id)
        if gap is not None:
            _log.error("run %d: %s from tick %d on", file.run_id, gap.text, gap.tick)
            self._clerk.reported(file.run_id, [gap])
        return True

    def _assign_events(self, filed_to: int) -> None:
        """Give the events up to a tick to the runs that they are of."""
        files = [*self._leaving, *([self.current] if self.current else [])]
        given: dict[int, list[LoopEvent]] = {}
        while self._waiting and self._waiting[0].tick <= filed_to:
            event = self._waiting.popleft()
            owner = next((file for file in files if file.owns(event)), None)
            if owner is not None:
                owner.events.append(event)
                given.setdefault(owner.run_id, []).append(event)
        for run_id, events in given.items():
            self._clerk.reported(run_id, events)

    def _leave(self, tick: int) -> None:
        """The present run has ended before this tick."""
        file, self.current = self.current, None
        if file is not None:
            file.left_at = tick
            file.abandon_part()
            self._leaving.append(file)

    def _hand_over(self) -> None:
        """Give the runs that have ended to the clerk."""
        for file in self._leaving:
            self._clerk.ended(file.run_id, file.recorded(self._tail_ticks), file.ending())
        self._leaving = []
