"""What a Bode diagram is asked for first: its peak, its dip, where it is down by 3 dB and late by 90°."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.signal import find_peaks

from app.analysis.phasors import Complex
from rtcore.compiled import Array

LEAST_DB = 0.02  # by which a peak stands above what is about it: less is a flat line
HALF_POWER_DB = 10 * math.log10(0.5)
HALF_DB = 20 * math.log10(0.5)


class Extreme(NamedTuple):
    """A peak or a dip of a frequency response."""

    frequency_hz: float
    gain_db: float


class Extremes(NamedTuple):
    """None where the response has no such point within the frequencies measured."""

    peak: Extreme | None
    dip: Extreme | None
    minus_3_db_hz: float | None
    minus_90_deg_hz: float | None


def find_extremes(frequencies_hz: npt.ArrayLike, response: npt.ArrayLike) -> Extremes:
    """Of a response without a unit at (n,) frequencies in any order, each once; dB and −3 dB against 1.

    Peak and dip are the most prominent within the band: beyond it a response has those of the structure,
    deeper than any of the loop's. Between points it is interpolated over the logarithm of frequency:
    extremes by a parabola, crossings by a line.
    """
    order = np.argsort(np.asarray(frequencies_hz, np.float64))
    octaves = np.log2(np.asarray(frequencies_hz, np.float64)[order])
    values: Complex = np.asarray(response, np.complex128)[order]
    there = np.abs(values) > 0
    octaves, values = octaves[there], values[there]
    gain_db = 20 * np.log10(np.abs(values))
    phase_deg = np.degrees(np.unwrap(np.angle(values)))
    within = slice(_band_end(gain_db))
    return Extremes(
        _most_prominent(octaves[within], gain_db[within], 1.0),
        _most_prominent(octaves[within], -gain_db[within], -1.0),
        _falls_below(octaves, gain_db, HALF_POWER_DB),
        _falls_below(octaves, phase_deg, -90.0),
    )


def _band_end(gain_db: Array) -> int:
    """How many points belong to the band: as far as it falls by half, to rise above −3 dB no more."""
    passed = np.flatnonzero(gain_db >= HALF_POWER_DB)
    if len(passed) == 0:
        return len(gain_db)
    fallen = np.flatnonzero(gain_db[passed[-1] :] < HALF_DB)
    return int(passed[-1] + fallen[0] + 1) if len(fallen) > 0 else len(gain_db)


def _most_prominent(octaves: Array, height: Array, sign: float) -> Extreme | None:
    """Of the points higher than those about them, that which stands out most; None of a flat line."""
    places, shapes = find_peaks(height, prominence=LEAST_DB)
    if len(places) == 0:
        return None
    at = int(places[np.argmax(shapes["prominences"])])
    x, y = octaves[at - 1 : at + 2] - octaves[at], height[at - 1 : at + 2]
    a, b, c = np.polyfit(x, y, 2)
    top = -b / (2 * a) if y[0] < y[1] > y[2] else 0.0  # or in the middle of a plateau
    return Extreme(float(2.0 ** (octaves[at] + top)), sign * float(c + b * top / 2))


def _falls_below(octaves: Array, height: Array, level: float) -> float | None:
    """Frequency at which it first does, coming from above."""
    below = np.flatnonzero((height[:-1] > level) & (height[1:] <= level))
    if len(below) == 0:
        return None
    at = below[0]
    share = (height[at] - level) / (height[at] - height[at + 1])
    return float(2.0 ** (octaves[at] + share * (octaves[at + 1] - octaves[at])))
