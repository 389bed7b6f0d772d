"""Rainflow counting after ASTM E1049, of a signal of any length in memory that does not grow."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import islice

import numpy as np
import numpy.typing as npt
from rainflow import extract_cycles

from app.analysis.turning_points import turning_points

GATE_N = 100.0  # a smaller range is noise of the load cell: 8 N rms reach ±45 N in an hour's ticks
CLASS_N = 250.0  # width of a class, of ranges and of means
HIGHEST_N = 100_000.0  # range: both ways of an overloaded rig
EXPONENTS = (
    3.0,
    5.0,
    7.0,
    10.0,
)  # of Wöhler curves: welds, machined steel, aluminium, smooth specimens
_CLASSES = round(HIGHEST_N / CLASS_N)
_BATCH = 8192

Chunks = Iterable[npt.NDArray[np.floating]]


@dataclass
class CountedCycles:
    """What a signal amounts to: (range class, mean class) → cycles, and sums over the cycles themselves.

    Half cycles, which the residue is counted as, are 0.5 each. `powers` are Σ n·(range/2)^m for each of
    `EXPONENTS`, of each cycle and not of its class.
    """

    matrix: npt.NDArray[np.float64] = field(default_factory=lambda: np.zeros((_CLASSES, _CLASSES)))
    powers: npt.NDArray[np.float64] = field(default_factory=lambda: np.zeros(len(EXPONENTS)))
    cycles: float = 0.0
    half_cycles: int = 0
    largest_range_n: float = 0.0

    def add(
        self,
        ranges_n: npt.NDArray[np.float64],
        means_n: npt.NDArray[np.float64],
        counts: npt.NDArray[np.float64],
    ) -> None:
        """Count (n,) cycles; `counts` are 1 or 0.5."""
        rows = np.clip(ranges_n // CLASS_N, 0, _CLASSES - 1).astype(np.int64)
        columns = np.clip((means_n + 0.5 * HIGHEST_N) // CLASS_N, 0, _CLASSES - 1).astype(np.int64)
        np.add.at(self.matrix, (rows, columns), counts)
        self.powers += [np.sum(counts * (0.5 * ranges_n) ** m) for m in EXPONENTS]
        self.cycles += float(np.sum(counts))
        self.half_cycles += int(np.count_nonzero(counts < 1))
        self.largest_range_n = float(np.max(ranges_n, initial=self.largest_range_n))

    def equivalent_amplitude_n(self, exponent: float, cycles: float) -> float:
        """The constant amplitude that does the same damage in so many cycles. 0 where there is none."""
        power = float(self.powers[EXPONENTS.index(exponent)])
        return (power / cycles) ** (1 / exponent) if cycles > 0 else 0.0


def count_cycles(force_n: Chunks, gate_n: float = GATE_N) -> CountedCycles:
    """Count the cycles of a force (N) that comes in chunks; ranges below the gate are none."""
    found = CountedCycles()
    cycles = iter_cycles(force_n, gate_n)
    while batch := list(islice(cycles, _BATCH)):
        ranges_n, means_n, counts = np.array(batch).T
        found.add(ranges_n, means_n, counts)
    return found


def iter_cycles(signal: Chunks, gate: float = 0.0) -> Iterator[tuple[float, float, float]]:
    """Range, mean and count (1, or 0.5 of the residue) of each cycle, as they close."""
    for extent, mean, count, _, _ in extract_cycles(_last_twice(turning_points(signal, gate))):
        yield extent, mean, count


def _last_twice(points: Iterable[float]) -> Iterator[float]:
    """The same signal: of one with two points only, the package tells nothing."""
    point = None
    for point in points:
        yield point
    if point is not None:
        yield point
