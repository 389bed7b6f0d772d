"""Is an estimate steady: does the output, less what the input explains, move more than its noise does?

A settling rig, a warming valve or a slowly changing specimen show as a trend within the stretch.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from app.analysis.phasors import Complex
from rtcore.compiled import Array

SURE = 0.01  # chance at which noise alone would be called a drift
NEGLIGIBLE = 0.002  # share of the output by which it may move from end to end, 0.02 dB


@dataclass(frozen=True)
class Drift:
    """By how much the first sums of the channels moved from end to end of a stretch: (channels,).

    `noise` (channels, channels) is the covariance of a sum without the drift, from so many lines.
    """

    moved: Complex
    noise: Complex
    lines: int

    def is_steady(self, weights: Complex, whole: complex) -> bool:
        """Whether a sum of channels moved no more than a little of `whole`, or than its noise."""
        if self.lines < 1:
            return False
        moved = float(abs(weights @ self.moved))
        if moved <= NEGLIGIBLE * abs(whole):
            return True
        # Along a slope of ±1/2 from end to end a sum has 1/12 of its power.
        power = 12.0 * power_of(weights, self.noise)
        return not is_unlikely(moved**2, power, self.lines, SURE)


def power_of(weights: Complex, noise: Complex) -> float:
    """Variance of a sum of channels, from the covariance (channels, channels) of their noise."""
    return max(0.0, float((weights @ noise @ weights.conj()).real))


def is_unlikely(power: float, noise_power: float, lines: int, chance: float) -> bool:
    """Whether noise, estimated from so many complex lines, would reach `power` more rarely than that."""
    if noise_power == 0.0:
        return power > 0.0
    return bool(fdtrc(2, 2 * lines, power / noise_power) < chance)


def drift_of(left: Complex, ticks: Array, share: float, beside: Complex) -> Drift:
    """From the residual sums (channels, cells) of cells with so many ticks, each that share of the stretch.

    `beside` (cells, lines) reads the lines beside the sine.
    """
    late = (np.arange(len(ticks)) + 0.5) * share - 0.5
    moved = 12.0 * (left @ late).astype(np.complex128)
    straight = np.outer(moved, ticks * late) / ticks.sum()
    found: Complex = (left - straight) @ beside
    lines = beside.shape[1] - 1
    return Drift(moved, found @ found.conj().T / max(1, lines), lines)
