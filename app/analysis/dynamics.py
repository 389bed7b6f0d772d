"""What a run's force and velocity were like: range, slope, noise, inertia; chunk after chunk, memory flat."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from app.analysis.cycle_statistics import Spread
from app.analysis.unit_force import REACH, Chain, Inertia
from app.analysis.walk import Columns

Floats = npt.NDArray[np.float64]
NEEDED = ("tick", "force_n", "force_command_n", "velocity_m_s", "wakeup_latency_s")
NOISE_ORDER = 6  # differences: what moves below a tenth of the loop rate is gone from them
_NOISE_GAIN = math.sqrt(math.comb(2 * NOISE_ORDER, NOISE_ORDER))  # of white noise
_KEPT = max(2 * REACH, NOISE_ORDER)


@dataclass
class MeanSquare:
    """Σx², largest |x| and count."""

    squares: float = 0.0
    peak: float = 0.0
    count: int = 0

    def take(self, values: Floats) -> None:
        """Count (n,) values."""
        self.squares += float(np.dot(values, values))
        self.peak = max(self.peak, float(np.max(np.abs(values), initial=0.0)))
        self.count += len(values)

    @property
    def rms(self) -> float:
        """0 of nothing."""
        return math.sqrt(self.squares / self.count) if self.count else 0.0


@dataclass
class Dynamics:
    """Figures over every tick of a run, holds and tapers included.

    `unit_n` is the force on the unit: the cell's less `inertia_n`. `error_n` and `unit_error_n` are the
    setpoint less either.
    """

    cell_n: Spread = field(default_factory=Spread)
    unit_n: Spread = field(default_factory=Spread)
    latency_s: Spread = field(default_factory=Spread)
    slope_n_s: MeanSquare = field(default_factory=MeanSquare)
    inertia_n: MeanSquare = field(default_factory=MeanSquare)
    error_n: MeanSquare = field(default_factory=MeanSquare)
    unit_error_n: MeanSquare = field(default_factory=MeanSquare)
    _rough_force: MeanSquare = field(default_factory=MeanSquare)
    _rough_velocity: MeanSquare = field(default_factory=MeanSquare)

    @property
    def force_noise_n(self) -> float:
        """The white noise of the load cell with its converter's steps, 1 sigma."""
        return self._rough_force.rms / _NOISE_GAIN

    @property
    def velocity_noise_m_s(self) -> float:
        """The same of the velocity."""
        return self._rough_velocity.rms / _NOISE_GAIN

    @property
    def frequency_hz(self) -> float:
        """Of the sine that has the force's deviation and slope; 0 where it stands still."""
        deviation = self.cell_n.deviation
        return self.slope_n_s.rms / (2 * math.pi * deviation) if deviation else 0.0


class DynamicsReader:
    """Takes a run chunk by chunk, each with the columns `NEEDED`; ticks need not be of its program."""

    def __init__(self, chain: Chain, period_s: float) -> None:
        self.found = Dynamics()
        self._period_s = period_s
        self._inertia = Inertia(chain, period_s)
        self._before: dict[str, npt.NDArray[np.float64]] | None = None

    def take(self, chunk: Columns) -> None:
        """The next ticks of the run."""
        for follows, piece in _pieces(chunk, self._before):
            self._take(piece, follows)

    def _take(self, piece: dict[str, Floats], follows: bool) -> None:
        if not follows:
            self._before = None
            self._inertia.restart()
        before = self._before
        whole = piece if before is None else _joined(before, piece)
        self._add(whole, 0 if before is None else len(before["tick"]))
        self._before = {name: values[-_KEPT:] for name, values in whole.items()}

    def _add(self, whole: dict[str, Floats], known: int) -> None:
        """Count what comes with the ticks from the number `known` on."""
        found, force, velocity = self.found, whole["force_n"], whole["velocity_m_s"]
        found.cell_n.take(force[known:])
        found.latency_s.take(whole["wakeup_latency_s"][known:])
        found.error_n.take(whole["force_command_n"][known:] - force[known:])
        found._rough_force.take(np.diff(force[max(0, known - NOISE_ORDER) :], NOISE_ORDER))
        found._rough_velocity.take(np.diff(velocity[max(0, known - NOISE_ORDER) :], NOISE_ORDER))
        start = max(0, known - 2 * REACH)
        force, velocity = force[start:], velocity[start:]
        inertia = self._inertia.take(force, velocity)
        unit = force[REACH : REACH + len(inertia)] - inertia
        command = whole["force_command_n"][start:][REACH : REACH + len(inertia)]
        found.inertia_n.take(inertia)
        found.unit_n.take(unit)
        found.unit_error_n.take(command - unit)
        found.slope_n_s.take((force[2:] - force[:-2])[: len(inertia)] / (2 * self._period_s))


def _pieces(
    chunk: Columns, before: dict[str, Floats] | None
) -> Iterator[tuple[bool, dict[str, Floats]]]:
    """Consecutive ticks that are all numbers, and whether each piece follows what came before it."""
    columns = {name: np.asarray(chunk[name], np.float64) for name in NEEDED}
    sound = np.isfinite(columns["force_n"]) & np.isfinite(columns["velocity_m_s"])
    columns = {name: values[sound] for name, values in columns.items()}
    ticks = columns["tick"]
    cuts = np.flatnonzero(np.diff(ticks) != 1) + 1
    follows = before is not None and len(ticks) > 0 and ticks[0] == before["tick"][-1] + 1
    for low, high in zip([0, *cuts], [*cuts, len(ticks)], strict=True):
        if low < high:
            yield follows, {name: values[low:high] for name, values in columns.items()}
        follows = False


def _joined(before: dict[str, Floats], piece: dict[str, Floats]) -> dict[str, Floats]:
    return {name: np.concatenate([before[name], piece[name]]) for name in piece}
