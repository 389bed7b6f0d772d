"""Streaming: a program of any length through the rings of its bank, written by the app, played by the loop.

The app fills what is free, the loop plays and says how far it is; so a day's time history takes no more memory than
a second's. Each count is published after what it counts.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.compiled import offset_of, write_index
from rtcore.program.segments import TABLE

Records = npt.NDArray[Any]

_COUNT, _KNOT_COUNT = offset_of(TABLE, "count"), offset_of(TABLE, "knot_count")


@dataclass(frozen=True)
class Course:
    """What force or motion does: arrays (n,) of SEGMENT, END last, and of KNOT, each in the order of playing.

    A course in one array of at most `MAX_SEGMENTS` may have REPEATs; a longer one is given without.
    """

    segments: Iterable[Records]
    knots: Iterable[Records] = ()


@dataclass(frozen=True)
class Program:
    """A load program: what the force does, and what the unit under test does meanwhile."""

    force: Course
    motion: Course


def resident(record: Any) -> Program:
    """A program from a PROGRAM record that holds all of it."""
    return Program(
        *(
            Course(
                [table["segments"][: table["count"]].copy()],
                [table["knots"][: table["knot_count"]].copy()],
            )
            for table in (record["force"], record["motion"])
        )
    )


@dataclass
class Ring:
    """One ring of a table, and what is still to be written into it."""

    records: Records
    count_address: int
    source: Iterator[Records]
    written: int = 0
    _waiting: Records = field(default_factory=lambda: np.empty(0))

    def fill(self, played: int) -> bool:
        """Write what there is room for; False once nothing is left. `played` records are done with."""
        size = len(self.records)
        before = self.written
        while (room := played + size - self.written) > 0 and self._has_more():
            part, self._waiting = self._waiting[:room], self._waiting[room:]
            slots = np.arange(self.written, self.written + len(part)) % size
            self.records[slots] = part
            self.written += len(part)
        if self.written != before:
            write_index(self.count_address, self.written)
        return self._has_more()

    def _has_more(self) -> bool:
        while len(self._waiting) == 0:
            following = next(self.source, None)
            if following is None:
                return False
            self._waiting = following
        return True


class TableWriter:
    """Fills one table of a bank, and keeps it filled while it is played."""

    def __init__(self, table: Any, course: Course) -> None:
        """Begin anew: fill what fits. `table` is a TABLE record in the memory of the loop."""
        address = int(table["segments"].ctypes.data) - offset_of(TABLE, "segments")
        for name in ("count", "knot_count", "streamed"):
            table[name] = 0
        self._segments = Ring(table["segments"], address + _COUNT, iter(course.segments))
        self._knots = Ring(table["knots"], address + _KNOT_COUNT, iter(course.knots))
        self.streaming = self.fill(0, 0)
        table["streamed"] = int(self.segments_follow)

    def fill(self, segment: int, knot: int) -> bool:
        """Write on, where the loop is at this segment and knot; False once everything has been given."""
        self.segments_follow = self._segments.fill(segment)
        self.knots_follow = self._knots.fill(knot)
        self.streaming = self.segments_follow or self.knots_follow
        return self.streaming


class ProgramWriter:
    """Fills a bank with a program, and keeps it filled."""

    def __init__(self, bank: Any, program: Program) -> None:
        self._force = TableWriter(bank["force"], program.force)
        self._motion = TableWriter(bank["motion"], program.motion)

    @property
    def streaming(self) -> bool:
        """Whether anything is still to be given."""
        return self._force.streaming or self._motion.streaming

    def fill(self, playing: Any) -> bool:
        """Write on, given the (2,) GENERATOR of force and motion; False once everything has been given."""
        force, motion = playing
        self._force.fill(int(force["segment"]), int(force["knot"]))
        self._motion.fill(int(motion["segment"]), int(motion["knot"]))
        return self.streaming
