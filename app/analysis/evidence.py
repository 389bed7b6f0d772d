"""What is known beforehand of a run: which ticks of its program are data, and of what."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple


class Kind(Enum):
    """What a stretch of the program is to the measurements."""

    LEAD = "lead"  # leads in, tapers, blends or settles: no data
    COURSE = "course"  # a hold, a ramp or samples: the force follows a course
    CYCLES = "cycles"  # counted cycles of one sine in full swing
    SWEEP = "sweep"  # counted cycles whose frequency moves
    STEP = "step"  # a sudden change, and the hold after it


class Sine(NamedTuple):
    """A harmonic setpoint in full swing; `asked_n` is the amplitude from which it may have been backed off."""

    frequency_hz: float
    amplitude_n: float
    mean_n: float
    asked_n: float | None = None

    @property
    def series_n(self) -> float:
        """The amplitude (N) of the series that it was played for."""
        return self.amplitude_n if self.asked_n is None else self.asked_n


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
