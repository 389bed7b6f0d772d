"""The acquisitions of a run under way: followed from one request to the next, never from the start."""

from collections import deque
from threading import Lock
from typing import NamedTuple

import numpy as np

from app.analysis.acquisition.table import Acquisition, Column, Rows, joined
from app.histories.history import Histories
from app.recording.samples import Samples, open_samples
from app.runs.acquiring import Asked, asked
from app.runs.measuring import Subject, read_definition

MOST_ROWS = 200_000  # of each table; the file has them all when the run is over


class Snapshot(NamedTuple):
    """An acquisition as far as it has got; the first `forgotten` of its rows are not kept."""

    asked: Asked
    columns: tuple[Column, ...]
    rows: int
    forgotten: int
    pieces: tuple[Rows, ...]

    def content(self) -> Rows:
        """The rows that are kept."""
        return joined(self.pieces, self.columns)


class _Table:
    """The newest rows of an acquisition that goes on."""

    def __init__(self, one: Asked, acquisition: Acquisition) -> None:
        self._asked = one
        self.acquisition = acquisition
        self._forgotten = 0
        self._pieces: deque[Rows] = deque()
        self._rows = 0

    def append(self, rows: Rows) -> None:
        """Add rows; the oldest are forgotten where there are too many."""
        count = _count(rows)
        if count == 0:
            return
        self._pieces.append(rows)
        self._rows += count
        while self._rows - _count(self._pieces[0]) >= MOST_ROWS:
            gone = _count(self._pieces.popleft())
            self._rows -= gone
            self._forgotten += gone

    def snapshot(self) -> Snapshot:
        """What there is now."""
        columns, rows = tuple(self.acquisition.columns), self._forgotten + self._rows
        return Snapshot(self._asked, columns, rows, self._forgotten, tuple(self._pieces))


class LiveAcquisitions:
    """Follows the run under way, when somebody asks for it."""

    def __init__(self, histories: Histories | None) -> None:
        self._histories = histories
        self._lock = Lock()
        self._run_id: int | None = None
        self._tables: list[_Table] = []
        self._last_tick = -1

    def tables(self, run_id: int, subject: Subject) -> list[Snapshot]:
        """The tables of a run as far as it is on disk. Raises `ValueError` and `OSError`."""
        with self._lock:
            samples = open_samples(subject.folder)
            if samples is None:
                return [table.snapshot() for table in self._begun(subject, 0)]
            if self._run_id != run_id:
                first = samples.first_tick if subject.first_tick is None else subject.first_tick
                self._tables = self._begun(subject, first)
                self._run_id, self._last_tick = run_id, samples.first_tick - 1
            self._follow(samples)
            return [table.snapshot() for table in self._tables]

    def _follow(self, samples: Samples) -> None:
        names = {name for table in self._tables for name in table.acquisition.needs}
        if not names:
            return
        for chunk in samples.chunks(sorted(names), self._last_tick + 1, samples.last_tick):
            for table in self._tables:
                table.append(table.acquisition.take(chunk))
            if len(chunk["tick"]):
                self._last_tick = int(chunk["tick"][-1])

    def _begun(self, subject: Subject, first_tick: int) -> list[_Table]:
        definition = read_definition(subject.definition, self._histories)
        return [_Table(one, one.begin(subject.period_s, first_tick)) for one in asked(definition)]


def _count(rows: Rows) -> int:
    return len(np.atleast_1d(next(iter(rows.values()))))
