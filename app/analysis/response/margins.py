"""The open loop and its margins, from what was measured while the loop was closed.

The plant is measured indirectly: both force and valve command are taken at the lines of the setpoint
alone, P = T_yr/T_vr and P_v likewise for the LVT, so the noise that the loop feeds back is no part of it.
The controller is known to the last digit. L = C·P − W·P_v, as in `app.analysis.linear`.
"""

import math
from typing import Any

import numpy as np

from app.analysis.linear import Margins
from app.analysis.phasors import Complex
from rtcore.compiled import Array
from rtcore.control.response import compensation_response, pid_response, shift


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


def margins_of(frequencies_hz: Array, loop: Complex) -> Margins:
    """Of an open loop at (n,) ascending frequencies, interpolated over the logarithm of frequency.

    NaN where it does not cross between the first and the last; the worst sensitivity is that of the
    frequencies measured.
    """
    octaves = np.log2(frequencies_hz)
    size_db, phase = 20 * np.log10(np.abs(loop)), np.unwrap(np.angle(loop))
    phase -= 2 * math.pi * round(float(phase[0]) / (2 * math.pi))
    crossover = phase_deg = gain_db = math.nan
    over = np.flatnonzero((size_db[:-1] > 0) & (size_db[1:] <= 0))
    if len(over) > 0:
        at, share = _crossing(size_db, int(over[-1]), 0.0)
        crossover = float(2.0 ** _between(octaves, at, share))
        phase_deg = 180.0 + math.degrees(_between(phase, at, share))
    turned = np.flatnonzero((phase[:-1] > -math.pi) & (phase[1:] <= -math.pi))
    if len(turned) > 0:
        gain_db = -_between(size_db, *_crossing(phase, int(turned[0]), -math.pi))
    return Margins(crossover, phase_deg, gain_db, float(np.max(1 / np.abs(1 + loop))))


def _crossing(values: Array, at: int, level: float) -> tuple[int, float]:
    return at, float((values[at] - level) / (values[at] - values[at + 1]))


def _between(values: Array, at: int, share: float) -> float:
    return float(values[at] + share * (values[at + 1] - values[at]))
