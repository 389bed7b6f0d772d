"""The open loop, from what was measured while the loop was closed, and the margins of any open loop.

The plant is measured indirectly: both force and valve command are taken at the lines of the setpoint
alone, P = T_yr/T_vr and P_v likewise for the LVT, so the noise that the loop feeds back is no part of it.
The controller is known to the last digit. L = C·P − W·P_v, as in `app.analysis.force_loop`.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from app.analysis.phasors import Complex
from rtcore.compiled import Array
from rtcore.control.response import compensation_response, pid_response, shift

TURN = 0.2  # radians, or neper, from one frequency to the next: more may hide a crossing and its return
HALVINGS = 8  # of a step between two frequencies, at most
LEAST_GAIN = 1e-300  # what is nothing at all, where its logarithm is taken


@dataclass(frozen=True)
class Margins:
    """Of an open loop, NaN where it does not cross.

    It may cross −180° and a gain of 1 several times, either way: of all of them `phase_deg` is the phase
    margin nearest to 0° and `crossover_hz` where it is, `gain_db` the gain margin nearest to 0 dB and
    `turnover_hz` where that is. A margin below zero is by how much gain or phase would have to come back; in
    a loop that is stable only with its gain (conditionally) it is by how much the gain may fall.
    `worst_sensitivity` is the peak of 1/|1 + L|.
    """

    crossover_hz: float
    phase_deg: float
    gain_db: float
    worst_sensitivity: float
    turnover_hz: float


def open_loop(
    frequencies_hz: Array,
    plant: Complex,
    motion: Complex,
    gains: Any,
    period_s: float,
    load_hz: float | None = None,
) -> Complex:
    """(n,) L of a GAINS record, from force (N) and rod velocity (m/s) to valve command.

    Both with the tick of delay and the hold, as the channels have them. `load_hz` is the frequency of
    the load where the compensation is on; without it the compensation is left out.
    """
    z = [shift(float(f), period_s) for f in frequencies_hz]
    loop = np.array([pid_response(gains, at, period_s) for at in z]) * plant
    if load_hz is not None:
        branch = [compensation_response(gains, load_hz, at, period_s) for at in z]
        loop = loop - np.array(branch) * motion
    return np.asarray(loop)


def followed(loops: Callable[[Array], Complex], frequencies_hz: Array) -> tuple[Array, Complex]:
    """A loop at (n,) ascending frequencies, and at those between that it takes to see every turn of it."""
    loop = loops(frequencies_hz)
    for _ in range(HALVINGS):
        with np.errstate(divide="ignore", invalid="ignore"):  # a loop may be nothing at all
            turns = np.abs(np.log(loop[1:] / loop[:-1])) > TURN
        between = np.sqrt(frequencies_hz[:-1] * frequencies_hz[1:])[turns]
        if len(between) == 0:
            break
        order = np.argsort(every := np.concatenate([frequencies_hz, between]))
        frequencies_hz, loop = every[order], np.concatenate([loop, loops(between)])[order]
    return frequencies_hz, loop


def margins_of(
    frequencies_hz: Array, loop: Complex, at: Callable[[float], complex] | None = None
) -> Margins:
    """Of an open loop at (n,) ascending frequencies, `at` being the loop at any between.

    Without it the logarithms of gain and phase are interpolated over that of frequency.
    """
    there = np.isfinite(loop)
    hz, known = frequencies_hz[there], loop[there]
    at = at or _between(hz, known)
    crossovers = {f: at(f) for f in _crossovers(hz, known, at)}
    turnovers = {f: at(f) for f in _turnovers(hz, known, at)}
    crossover = min(crossovers, key=lambda f: abs(_phase_deg(crossovers[f])), default=math.nan)
    turnover = min(turnovers, key=lambda f: abs(_gain_db(turnovers[f])), default=math.nan)
    near = np.concatenate([known, [*crossovers.values(), *turnovers.values()]])
    return Margins(
        crossover,
        _phase_deg(crossovers[crossover]) if crossovers else math.nan,
        _gain_db(turnovers[turnover]) if turnovers else math.nan,
        float(1.0 / np.min(np.abs(1.0 + near), initial=math.inf)),
        turnover,
    )


def _phase_deg(loop: complex) -> float:
    """The phase margin where the gain is 1, within ±180°."""
    return math.degrees(np.angle(-loop))


def _gain_db(loop: complex) -> float:
    """The gain margin where the phase is −180°."""
    return -20.0 * math.log10(max(abs(loop), LEAST_GAIN))


def _crossovers(hz: Array, loop: Complex, at: Callable[[float], complex]) -> Iterator[float]:
    """Wherever the gain becomes 1, from above or below."""
    over = np.abs(loop) > 1.0
    for i in np.flatnonzero(over[:-1] != over[1:]):
        yield _root(lambda f: abs(at(f)) - 1.0, *hz[i : i + 2])


def _turnovers(hz: Array, loop: Complex, at: Callable[[float], complex]) -> Iterator[float]:
    """Wherever the phase becomes −180°, or that with whole turns, from either side."""
    ahead = np.angle(-loop[:-1])
    then = ahead + np.angle(loop[1:] * loop[:-1].conj())  # the shorter way round
    for i in np.flatnonzero((ahead < 0) != (then < 0)):
        yield _root(lambda f: at(f).imag, *hz[i : i + 2])


def _root(of: Callable[[float], float], low: float, high: float) -> float:
    ends = {low: of(low), high: of(high)}
    if ends[low] * ends[high] > 0:  # it is at one of them, rounding has taken it beyond
        return float(min(ends, key=lambda f: abs(ends[f])))
    return float(brentq(of, low, high))


def _between(hz: Array, loop: Complex) -> Callable[[float], complex]:
    octaves, phase = np.log2(hz), np.unwrap(np.angle(loop))
    neper = np.log(np.maximum(np.abs(loop), LEAST_GAIN))

    def at(frequency_hz: float) -> complex:
        octave = np.log2(frequency_hz)
        turned = np.interp(octave, octaves, phase)
        return complex(np.exp(np.interp(octave, octaves, neper) + 1j * turned))

    return at
