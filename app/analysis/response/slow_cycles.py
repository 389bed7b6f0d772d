"""Static stiffness, hysteresis and backlash of the unit under test, from slow cycles of its load.

The rod's way is the integral of its velocity, which wanders: that it is back where it was after each
cycle takes the wandering off. Behind the springs of the chain what is left is the unit's deformation.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Array
from rtcore.rig.parameters import RigParameters

OUTER = 0.4  # of the largest force: beyond it free play is taken up


class SlowCycles(NamedTuple):
    """Of the unit alone. Backlash is what is left between the straight lines of push and pull at no force."""

    stiffness_n_m: float
    stiffness_std_n_m: float  # from cycle to cycle; NaN of a single one
    hysteresis_j: float  # energy lost in a cycle
    hysteresis_std_j: float  # from cycle to cycle; NaN of a single one
    backlash_m: float
    cycles: int


def unit_deformation(
    force_n: npt.ArrayLike,
    velocity_m_s: npt.ArrayLike,
    displacement_m: npt.ArrayLike,
    cycle_ticks: int,
    period_s: float,
    rig: RigParameters,
) -> tuple[Array, Array]:
    """(cycles, cycle_ticks) force and deformation (m) of the unit, from load cell, LVT and LVDT."""
    count = len(np.asarray(force_n)) // cycle_ticks
    force, velocity, moved = (
        np.asarray(values, np.float64)[: count * cycle_ticks].reshape(count, cycle_ticks)
        for values in (force_n, velocity_m_s, displacement_m)
    )
    part = rig.structure
    closed = velocity - velocity.mean(axis=1, keepdims=True)
    way = np.cumsum(closed, axis=1) * period_s - closed * period_s / 2
    springs = force * (1 / part.k_pl + 1 / part.k_lc + 1 / part.k_2)
    deformation = way - springs - moved
    return force, deformation - deformation.mean(axis=1, keepdims=True)


def slow_cycles(force_n: Array, deformation_m: Array) -> SlowCycles:
    """From (cycles, ticks) of whole cycles of pushing and pulling, each from the same phase.

    Raises ValueError where there is no cycle, or where it does not push and pull.
    """
    if len(force_n) == 0 or not force_n.min() < 0 < force_n.max():
        raise ValueError("slow cycles push and pull, and at least one is whole")
    slopes = np.array([_slope(f, x) for f, x in zip(force_n, deformation_m, strict=True)])
    lost = np.array([_area(f, x) for f, x in zip(force_n, deformation_m, strict=True)])
    force, deformation = force_n.mean(axis=0), deformation_m.mean(axis=0)
    outer = OUTER * np.max(np.abs(force))
    push = np.polyfit(force[force > outer], deformation[force > outer], 1)
    pull = np.polyfit(force[force < -outer], deformation[force < -outer], 1)
    stiffness = 1 / slopes
    return SlowCycles(
        float(1 / np.mean(slopes)),
        _spread(stiffness),
        abs(float(np.mean(lost))),  # of noise alone the sign differs from cycle to cycle
        _spread(lost),
        float(push[1] - pull[1]),
        len(slopes),
    )


def _spread(values: Array) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else float("nan")


def _slope(force_n: Array, deformation_m: Array) -> float:
    """m/N beyond the free play, push and pull alike."""
    outer = OUTER * np.max(np.abs(force_n))
    sides = (force_n > outer, force_n < -outer)
    return float(np.mean([np.polyfit(force_n[s], deformation_m[s], 1)[0] for s in sides]))


def _area(force_n: Array, deformation_m: Array) -> float:
    """∮ F dx of a closed cycle."""
    ahead = np.roll(deformation_m, -1) - deformation_m
    return float(np.sum(ahead * (force_n + np.roll(force_n, -1)) / 2))
