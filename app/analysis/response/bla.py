"""The best linear approximation of a rig that is not quite linear, by random-phase multisines.

Pintelon and Schoukens, System Identification, 2nd ed., chapters 3 and 4. What differs from period to
period is noise; what is the same in each period but differs from one realisation of the phases to the
next is distortion. The robust method takes several realisations; the fast one takes the distortion from
lines that an odd multisine leaves out, where a linear rig would give nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.analysis.phasors import Complex
from app.analysis.response.curve import Curve
from app.analysis.response.periods import Realisation
from rtcore.compiled import Array

NEAREST = 6  # lines left out that tell the distortion of an excited one


@dataclass(frozen=True)
class BestLinear(Curve):
    """A curve whose variance is known in parts, (n,) each; NaN where it is not.

    `noise_variance` is what noise adds to `gain`; `nonlinear_variance` that by which one realisation
    differs from the next without noise.
    """

    noise_variance: Array
    nonlinear_variance: Array
    realisations: int


def robust(
    realisations: Sequence[Realisation],
    input: str,
    output: str,
    excited: npt.NDArray[np.int64],
    period_s: float,
) -> BestLinear:
    """At the `excited` lines, from realisations of the same period of `period_s` (s).

    Raises ValueError where there is none. With one, the interval is that of the noise alone.
    """
    if not realisations:
        raise ValueError("a best linear approximation needs at least one realisation")
    found = [_single(r, input, output, excited) for r in realisations]
    gains = np.array([gain for gain, _ in found])
    count = len(found)
    gain = gains.mean(axis=0)
    noise = np.mean([variance for _, variance in found], axis=0) / count
    if count == 1:
        total, nonlinear = noise, np.full(len(gain), np.nan)
        lines = max(0, realisations[0].periods - 1)
    else:
        total = np.sum(np.abs(gains - gain) ** 2, axis=0) / (count - 1) / count
        nonlinear = np.maximum(0.0, count * (total - noise))
        lines = count - 1
    return _best(excited / period_s, gain, total, lines, noise, nonlinear, count)


def fast(
    realisations: Sequence[Realisation],
    input: str,
    output: str,
    excited: npt.NDArray[np.int64],
    left_out: npt.NDArray[np.int64],
    period_s: float,
) -> BestLinear:
    """As `robust`, the distortion taken from the odd lines `left_out`; one realisation is enough.

    In a closed loop something stands at those lines in the input too: what the rig makes linearly of it is
    taken off. Raises ValueError where no line is left out.
    """
    if len(left_out) == 0 or not realisations:
        raise ValueError("the fast method needs a realisation with lines left out")
    gains, noises, odds = [], [], []
    for r in realisations:
        gain, noise = _single(r, input, output, excited)
        at = np.interp(left_out, excited, gain.real) + 1j * np.interp(left_out, excited, gain.imag)
        u, y = _lines_of(r, input, left_out), _lines_of(r, output, left_out)
        scatter = _scatter(r, input, output, left_out, at) / r.periods
        # As a share of the gain it changes little from line to line, even where the gain does.
        odd = _nearby(np.abs((y - at * u) / at) ** 2, left_out, excited)
        own = np.where(np.isnan(scatter), 0.0, scatter) / np.abs(at) ** 2
        own = _nearby(own, left_out, excited)
        size = np.abs(_lines_of(r, input, excited) / gain) ** 2
        gains.append(gain)
        noises.append(noise)
        odds.append(np.stack([odd, own]) / size)
    count = len(gains)
    gain, noise = np.mean(gains, axis=0), np.mean(noises, axis=0) / count
    seen, own = np.mean(odds, axis=0)
    lines = min(NEAREST, len(left_out)) * count
    nonlinear = np.maximum(0.0, seen - own)
    total = seen / count  # distortion and the noise of a mean of periods together
    return _best(excited / period_s, gain, total, lines, noise, nonlinear, count)


def _single(
    r: Realisation, input: str, output: str, excited: npt.NDArray[np.int64]
) -> tuple[Complex, Array]:
    """Gain of one realisation and what the noise of its periods makes of its variance."""
    u, y = _lines_of(r, input, excited), _lines_of(r, output, excited)
    gain = y / u
    variance = _scatter(r, input, output, excited, gain) / r.periods / np.abs(u) ** 2
    return gain, variance


def _scatter(
    r: Realisation, input: str, output: str, lines: npt.NDArray[np.int64], gain: Complex
) -> Array:
    """Variance of output − gain · input from period to period; NaN of a single one."""
    if r.periods < 2:
        return np.full(len(lines), np.nan)
    u, y = r.channels.index(input), r.channels.index(output)
    noise = r.noise[np.searchsorted(r.lines, lines)]
    crossed = 2 * (gain.conj() * noise[:, y, u]).real
    left = noise[:, y, y].real - crossed + np.abs(gain) ** 2 * noise[:, u, u].real
    return np.asarray(np.maximum(0.0, left))


def _lines_of(r: Realisation, channel: str, lines: npt.NDArray[np.int64]) -> Complex:
    return np.asarray(r.of(channel)[np.searchsorted(r.lines, lines)])


def _nearby(power: Array, at: npt.NDArray[np.int64], wanted: npt.NDArray[np.int64]) -> Array:
    """(wanted,) mean of the `NEAREST` of (at,) around each."""
    count = min(NEAREST, len(at))
    first = np.searchsorted(at, wanted) - count // 2
    first = np.clip(first, 0, len(at) - count)
    sums = np.concatenate([[0.0], np.cumsum(power)])
    return np.asarray((sums[first + count] - sums[first]) / count)


def _best(
    frequencies_hz: Array,
    gain: Complex,
    variance: Array,
    lines: int,
    noise: Array,
    nonlinear: Array,
    realisations: int,
) -> BestLinear:
    explained = np.abs(gain) ** 2
    other = variance * realisations
    with np.errstate(invalid="ignore"):  # neither output nor noise
        coherence = explained / (explained + other)  # NaN where no variance is known
    freedom = np.full(len(gain), float(lines))
    known = np.where(np.isnan(variance), 0.0, variance)
    return BestLinear(
        frequencies_hz, gain, known, freedom, coherence, noise, nonlinear, realisations
    )
