"""Finds the slow cycles of a run, and what they tell of the unit under test: stiffness, hysteresis, backlash."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Kind, Sine
from app.analysis.response.slow_cycles import SlowCycles, slow_cycles, unit_deformation
from app.analysis.walk import Part
from rtcore.rig.parameters import RigParameters

SLOW_HZ = 2.0  # up to here the masses of the chain take nothing that shows: 0.1 % of its stiffness
LEAST_CYCLES = 3  # whole ones: fewer say nothing of how they spread
LEAST_SHARE = 0.5  # of the larger force, that the smaller side reaches: it both pushes and pulls
MOST_TICKS = 800_000  # kept of one stretch, 10 MB: 200 s
MOST_SINES = 100
CHANNELS = ("force_n", "velocity_m_s", "displacement_m")


class SlowSine(NamedTuple):
    """A slow sine of a block, and the unit as its cycles show it."""

    block: int
    sine: Sine
    unit: SlowCycles


class SlowReader:
    """Takes a run part after part. Of a sine that comes several times, the most cycles in one go count."""

    def __init__(self, period_s: float, rig: RigParameters) -> None:
        self._period_s, self._rig = period_s, rig
        self._at: tuple[int, Sine] | None = None
        self._ticks: list[npt.NDArray[np.int64]] = []  # as recorded, −1 where the phase is another
        self._kept: dict[str, list[npt.NDArray[np.float32]]] = {}
        self._count = 0
        self._found: dict[tuple[int, Sine], SlowCycles] = {}

    def take(self, part: Part) -> None:
        """The next part of the run, of whatever kind."""
        if part.begins:
            self._file()
            sine = part.stretch.sine if part.stretch.kind is Kind.CYCLES else None
            if sine is not None and is_slow(sine) and len(self._found) < MOST_SINES:
                self._at = part.stretch.block, sine
        room = MOST_TICKS - self._count
        if self._at is None or room <= 0:
            return
        ticks = np.where(part.in_phase, part.columns["tick"], -1)[:room].astype(np.int64)
        self._ticks.append(ticks)
        for name in CHANNELS:
            self._kept.setdefault(name, []).append(part.columns[name][:room].astype(np.float32))
        self._count += len(ticks)

    def result(self) -> tuple[SlowSine, ...]:
        """What was found, in the order of the test; nothing can be taken afterwards."""
        self._file()
        return tuple(SlowSine(*key, unit) for key, unit in self._found.items())

    def _file(self) -> None:
        """Read the cycles of the stretch that has ended."""
        at, ticks, kept = self._at, self._ticks, self._kept
        self._at, self._ticks, self._kept, self._count = None, [], {}, 0
        if at is None or not ticks:
            return
        columns = {name: np.concatenate(parts) for name, parts in kept.items()}
        cycle_ticks = 1 / (at[1].frequency_hz * self._period_s)
        whole = list(_whole_cycles(np.concatenate(ticks), cycle_ticks))
        if len(whole) < LEAST_CYCLES:
            return
        signals = [np.concatenate([columns[name][c] for c in whole]) for name in CHANNELS]
        found = self._read(signals, int(cycle_ticks))
        before = self._found.get(at)
        if found is not None and (before is None or before.cycles < found.cycles):
            self._found[at] = found

    def _read(self, signals: list[npt.NDArray[np.float32]], ticks: int) -> SlowCycles | None:
        force, velocity, moved = signals
        if min(force.max(), -force.min()) < LEAST_SHARE * np.abs(force).max():
            return None  # what was applied is not what was asked for
        return slow_cycles(
            *unit_deformation(force, velocity, moved, ticks, self._period_s, self._rig)
        )


def is_slow(sine: Sine) -> bool:
    """Whether a sine is slow, and both pushes and pulls enough for the unit to be read from it."""
    reaches = sine.amplitude_n - abs(sine.mean_n), sine.amplitude_n + abs(sine.mean_n)
    return sine.frequency_hz <= SLOW_HZ and reaches[0] >= LEAST_SHARE * reaches[1] > 0


def _whole_cycles(ticks: npt.NDArray[np.int64], cycle_ticks: float) -> Iterator[slice]:
    """Of (n,) ticks those of each cycle in which none is missing, held or out of phase; all of one length.

    What was left out before a cycle moves its begin: where the test was held, no cycle after it counts.
    """
    size = int(cycle_ticks)
    for number in range(int(len(ticks) / cycle_ticks)):
        begin = round(number * cycle_ticks)
        end = begin + size
        if end > len(ticks) or ticks[end - 1] - ticks[0] != end - 1 or ticks[0] < 0:
            return
        yield slice(begin, end)
