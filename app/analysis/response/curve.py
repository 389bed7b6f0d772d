"""A response at many frequencies with how far each value can be trusted; what all estimators give."""

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from app.analysis.phasors import Complex
from rtcore.compiled import Array

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Curve:
    """(n,) each. `variance` is that of `gain` as a complex number, estimated from so many complex `lines`.

    Where `lines` is 0 nothing is known of the variance: the intervals have no bounds, the coherence is NaN.
    """

    frequencies_hz: Array
    gain: Complex
    variance: Array
    lines: Array
    coherence: Array

    @property
    def half_width(self) -> Array:
        """(n,) of the 95 % interval, along any one direction in the plane of the gain."""
        return half_width(self.variance, self.lines)

    @property
    def gain_95(self) -> Array:
        """(n, 2) of the magnitude."""
        return magnitude_interval(self.gain, self.half_width)

    @property
    def phase_95_deg(self) -> Array:
        """(n, 2) of the phase."""
        return phase_interval_deg(self.gain, self.half_width)


def half_width(variance: Array, lines: Array) -> Array:
    """Of a 95 % interval by Student's t; a complex line has two degrees of freedom."""
    known = np.asarray(lines) > 0
    t = stdtrit(2 * np.where(known, lines, 1), 0.5 + CONFIDENCE / 2)
    return np.asarray(np.where(known, t * np.sqrt(np.asarray(variance) / 2), np.inf))


def magnitude_interval(gain: Complex, half: Array) -> Array:
    """(..., 2): it does not go below 0."""
    size = np.abs(gain)
    return np.stack([np.maximum(0.0, size - half), size + half], axis=-1)


def phase_interval_deg(gain: Complex, half: Array) -> Array:
    """(..., 2): a whole turn where nothing is known of the phase."""
    size, at = np.abs(gain), np.degrees(np.angle(gain))
    inside = half < size
    share = np.divide(half, size, out=np.zeros_like(size), where=inside)
    wide = np.where(inside, np.degrees(np.arcsin(share)), 180.0)
    return np.stack([at - wide, at + wide], axis=-1)
