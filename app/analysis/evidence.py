"""What is known beforehand of a run: which ticks of its program are data, and of what."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from rtcore.modes import Mode

HOLD_FADE_S = 0.25  # how long the loop takes to fade back in after a hold


class Kind(Enum):
    """What a stretch of the program is to the measurements."""

    LEAD = "lead"  # leads in, tapers, blends or settles: no data
    COURSE = "course"  # a hold, a ramp or samples: the force follows a course
    CYCLES = "cycles"  # counted cycles of one sine in full swing
    SWEEP = "sweep"  # counted cycles whose frequency moves
    STEP = "step"  # a sudden change, and the hold after it


class Sine(NamedTuple):
    """A harmonic setpoint in full swing."""

    frequency_hz: float
    amplitude_n: float
    mean_n: float


class Stretch(NamedTuple):
    """Ticks of the program from `first` to before `last`: one piece of one block.

    The stretches of a program follow one another without a gap, in playing order; long programs
    have many, so they are iterated and never listed. `path` is that of the block in the definition,
    ("blocks", 1, "blocks", 0); `block` is its first index.
    """

    first: int
    last: int
    kind: Kind
    path: tuple[str | int, ...] = ("blocks", 0)
    begin_n: float = 0.0  # setpoint before it
    end_n: float = 0.0  # and after it
    sine: Sine | None = None  # of CYCLES
    cycles: int = 0  # that it counts when it is played to its end
    continues: bool = False  # a harmonic that goes on with the phase of the one before it

    @property
    def block(self) -> int:
        """Number of the block of the test, as in the telemetry."""
        return int(self.path[1])

    @property
    def counts(self) -> bool:
        """Whether its cycles are counted."""
        return self.kind in (Kind.CYCLES, Kind.SWEEP)


class StepWindow(NamedTuple):
    """A step of the force setpoint: its ticks in the program, and from where to where (N)."""

    first: int
    last: int  # one past
    begin_n: float
    end_n: float


@dataclass(frozen=True)
class Windows:
    """The data of a short program at a glance: (first, one past) of each stretch of counted cycles."""

    ticks: int  # of the whole program
    cycles: Sequence[tuple[int, int]] = ()
    steps: Sequence[StepWindow] = ()


@dataclass(frozen=True)
class Evidence:
    """The ticks of a run, (n,) TELEMETRY, in which its program went on, and what is known of them.

    `program_ticks` (n,) says which tick of the program each of them is. `reference_n` (n,) is the
    force of a reference run at the same ticks, where there is one.
    """

    records: npt.NDArray[Any]
    program_ticks: npt.NDArray[np.int64]
    windows: Windows
    period_s: float
    valve_limit: float = 1.0
    reference_n: npt.NDArray[np.float64] | None = None
    _data: list[npt.NDArray[Any]] = field(default_factory=list, repr=False)

    @property
    def data(self) -> npt.NDArray[Any]:
        """The records of counted cycles; all of them where the test has no harmonic load."""
        return self.records[self.data_mask]

    @property
    def data_mask(self) -> npt.NDArray[np.bool_]:
        """(n,) which records are data."""
        if not self._data:
            self._data.append(self._mask())
        return self._data[0]

    def within(self, first: int, last: int) -> npt.NDArray[Any]:
        """The records of the program's ticks from `first` to before `last`."""
        begin, end = np.searchsorted(self.program_ticks, [first, last])
        return self.records[begin:end]

    def _mask(self) -> npt.NDArray[np.bool_]:
        if not self.windows.cycles:
            return np.ones(len(self.records), np.bool_)
        edges = np.asarray(self.windows.cycles, np.int64).ravel()
        # Between a stretch's first tick and its end an odd number of edges has been passed.
        passed = np.searchsorted(edges, self.program_ticks, side="right")
        return np.asarray(passed % 2 == 1)


def gather(
    records: npt.NDArray[Any],
    windows: Windows,
    period_s: float,
    valve_limit: float = 1.0,
    reference: npt.NDArray[Any] | None = None,
) -> Evidence:
    """The evidence of a run from all its ticks, (n,) TELEMETRY; so is `reference`, if there is one.

    Ticks in which the program did not go on (held, being stopped, tripped) are left out.
    """
    kept, ticks = _in_program(records, windows, period_s)
    if reference is None:
        return Evidence(kept, ticks, windows, period_s, valve_limit)
    other, other_ticks = _in_program(reference, windows, period_s)
    _, mine, theirs = np.intersect1d(ticks, other_ticks, return_indices=True)
    force_n = other["force_n"][theirs].astype(np.float64)
    return Evidence(kept[mine], ticks[mine], windows, period_s, valve_limit, force_n)


def _in_program(
    records: npt.NDArray[Any], windows: Windows, period_s: float
) -> tuple[npt.NDArray[Any], npt.NDArray[np.int64]]:
    frozen = _frozen(records["mode"], round(HOLD_FADE_S / period_s))
    since_start = records["tick"] - records["tick"][0] if len(records) else np.zeros(0, np.int64)
    position = since_start - np.cumsum(frozen)
    kept = ~frozen & (records["mode"] == Mode.RUNNING) & (position < windows.ticks)
    return records[kept], position[kept].astype(np.int64)


def _frozen(mode: npt.NDArray[np.int8], fade_ticks: int) -> npt.NDArray[np.bool_]:
    """(n,) whether the program stands still: held, or fading back in after a hold."""
    frozen = np.asarray(mode == Mode.HOLDING)
    edges = np.flatnonzero(np.diff(frozen.astype(np.int8), prepend=0, append=0))
    for first, last in edges.reshape(-1, 2):
        frozen[last : last + min(last - first, fade_ticks) - 1] = True
    return frozen
