"""Damage of the force that was applied against that of the spectrum that was asked for.

Palmgren and Miner add the damages of cycles, each (amplitude)^m by the Wöhler curve's exponent m. The
curve itself is the part's and is not known here, so damages are told relative to one another; it is taken
to have no fatigue limit and no influence of the mean.
"""

from typing import NamedTuple

import numpy as np

from app.analysis.rainflow_counting import CLASS_N, EXPONENTS, HIGHEST_N, CountedCycles

MOST_CLASSES = 24
_WIDTHS_N = tuple(CLASS_N * k for k in (1, 2, 4, 8, 20, 40))


class Damage(NamedTuple):
    """Of one exponent. `ratio` is applied over asked, None where nothing was asked.

    Both amplitudes do in `cycles` cycles, those asked for, the damage that was asked for and applied.
    """

    exponent: float
    cycles: float
    asked_amplitude_n: float
    applied_amplitude_n: float
    ratio: float | None


class RangeClass(NamedTuple):
    """Cycles whose range is from `from_n` to before `to_n`."""

    from_n: float
    to_n: float
    asked: float
    applied: float


class MatrixCell(NamedTuple):
    """Cycles that were applied, by class of range and of mean: the lower ends of the classes."""

    range_n: float
    mean_n: float
    cycles: float


def damages(asked: CountedCycles, applied: CountedCycles) -> tuple[Damage, ...]:
    """The damage for each Wöhler exponent."""
    return tuple(_damage(asked, applied, place) for place in range(len(EXPONENTS)))


def class_width_n(*counted: CountedCycles) -> float:
    """The least width of classes by which there are few enough of them."""
    largest_n = max((one.largest_range_n for one in counted), default=0.0)
    return next((w for w in _WIDTHS_N if largest_n <= w * MOST_CLASSES), _WIDTHS_N[-1])


def spectrum(asked: CountedCycles, applied: CountedCycles) -> tuple[RangeClass, ...]:
    """Cycles by range, from zero to the class of the largest."""
    width_n = class_width_n(asked, applied)
    fine = round(width_n / CLASS_N)
    of_each = [one.matrix.sum(axis=1).reshape(-1, fine).sum(axis=1) for one in (asked, applied)]
    last = max((int(rows.nonzero()[0].max(initial=-1)) for rows in of_each), default=-1)
    return tuple(
        RangeClass(k * width_n, (k + 1) * width_n, float(of_each[0][k]), float(of_each[1][k]))
        for k in range(last + 1)
    )


def matrix(counted: CountedCycles, width_n: float) -> tuple[MatrixCell, ...]:
    """The classes that have cycles, in order of range and mean."""
    fine = round(width_n / CLASS_N)
    coarse = counted.matrix.reshape(-1, fine, counted.matrix.shape[1] // fine, fine).sum(
        axis=(1, 3)
    )
    return tuple(
        MatrixCell(i * width_n, j * width_n - 0.5 * HIGHEST_N, float(coarse[i, j]))
        for i, j in np.argwhere(coarse).tolist()
    )


def _damage(asked: CountedCycles, applied: CountedCycles, place: int) -> Damage:
    exponent, cycles = EXPONENTS[place], asked.cycles
    wanted, done = float(asked.powers[place]), float(applied.powers[place])
    return Damage(
        exponent,
        cycles,
        asked.equivalent_amplitude_n(exponent, cycles),
        applied.equivalent_amplitude_n(exponent, cycles),
        done / wanted if wanted > 0 else None,
    )
