"""What blocks and motions are made of: pieces, each a segment of the loop's program, and loops.

The same for force (N) and motion (m): only lead-in and limits differ.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from app.definitions.limits import RIG
from app.documents.tree import Path
from app.histories.curve import Values, pieces
from app.histories.history import History
from rtcore.program.segments import Branch, Segment

STEEPEST = math.pi / 2  # slope of half a cosine in its middle, over its mean slope


SWINGING = (Segment.HARMONIC, Segment.SWEEP)


@dataclass(frozen=True, slots=True)
class Track:
    """Samples times `gain` plus `offset`, in N or m, that a piece plays."""

    history: History
    gain: float
    offset: float = 0.0
    held: float = math.nan  # what a hold fades to; NaN: it stays where it is
    begin: int = 0  # the first sample whose knot is given

    def at(self, value: float) -> float:
        """A sample as it is played."""
        return self.offset + self.gain * value

    @property
    def first(self) -> float:
        """Where it begins."""
        return self.at(self.history.statistics.first)

    @property
    def last(self) -> float:
        """Where it ends."""
        return self.at(self.history.statistics.last)

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest value; the curve does not go beyond its samples."""
        found = self.history.statistics
        low, high = sorted((self.at(found.low), self.at(found.high)))
        return low, high

    def knots(self) -> Iterator[tuple[Values, Values]]:
        """Values and slopes (change an interval), part after part, (n,) each."""
        for _, values, slopes in pieces(self.history.values, self.begin):
            yield self.offset + self.gain * values, self.gain * slopes


@dataclass(frozen=True, slots=True)
class Piece:
    """One segment; the fields that `SEGMENT` has bear its names."""

    kind: Segment
    ticks: int = 0
    target: float = 0.0
    rate_per_s: float = 0.0
    mean_from: float = 0.0
    mean_to: float = 0.0
    amplitude_from: float = 0.0
    amplitude_to: float = 0.0
    frequency_from_hz: float = 0.0
    frequency_to_hz: float = 0.0
    phase_cycles: float = 0.0
    continues: int = 0
    counts: int = 0
    times: int = 0  # knots of a track
    track: Track | None = None
    branch: Branch = Branch.EXCLUDED
    is_step: bool = False  # meant to be sudden
    asked: float | None = None  # amplitude from which a sine may have been backed off
    origin: Path = ()  # the block it serves: ("blocks", 1, "blocks", 0)


@dataclass(frozen=True, slots=True)
class Loop:
    """Nodes, so many times in all."""

    times: int
    body: tuple["Node", ...]
    origin: Path = ()


Node = Piece | Loop


@dataclass(frozen=True, slots=True)
class Sine:
    """A harmonic in full swing: `mean` and `amplitude` in N or m; `asked`: that from which it may be backed off."""

    mean: float
    amplitude: float
    frequency_hz: float
    asked: float | None = None


def unrolled(nodes: Iterable[Node]) -> Iterator[Piece]:
    """Every piece in the order in which it is played."""
    for node in nodes:
        if isinstance(node, Piece):
            yield node
        else:
            for _ in range(node.times):
                yield from unrolled(node.body)


def loops_within(nodes: Iterable[Node]) -> int:
    """How many loops deep nodes are."""
    return max((1 + loops_within(n.body) for n in nodes if isinstance(n, Loop)), default=0)


def whole_ticks(duration_s: float) -> int:
    """The nearest whole number of ticks, at least 1."""
    endless_s = 2 * RIG.duration_limit_s  # longer makes no difference: it is refused
    return max(1, math.floor(min(duration_s, endless_s) / RIG.period_s + 0.5))
