"""Frequency response of a sweep, or of any excitation: the local polynomial method.

The spectrum of the whole sweep is taken at once, so nothing is assumed of how slowly it goes. Around each
frequency response and transient are smooth, so output = G(f)·U + T(f) with a parabola each is fitted to
the lines nearby, and what does not fit is the noise (Pintelon, Schoukens, Vandersteen and Barbé, Mech.
Syst. Signal Process. 24, 2010). With a reference both channels are fitted against it and divided: noise
that a closed loop feeds back is then no part of the response.

What is excited at the very ends of the record cannot be told from the transient: its spectrum is as smooth. A
sweep that begins and ends at rest has none, so there it is left out of the fit, and only what differs between the
two rests is taken off.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from app.analysis.phasors import Complex
from app.analysis.response.curve import Curve
from rtcore.compiled import Array

Samples = npt.NDArray[np.floating]
ORDER = 2  # of the polynomials
LEAST_SPARE = 6  # lines more than unknowns
MOST_CONFOUNDED = 1.2  # times as far as noise moves the gain where the transient is fitted too
REST_TICKS = 40  # over which the level at either end is read


class _Local(NamedTuple):
    """What the lines around a frequency say: `lines` of them are left for the noise."""

    gain: complex
    variance: float
    coherence: float
    lines: int


def swept_response(
    input: Samples,
    output: Samples,
    period_s: float,
    frequencies_hz: Array,
    *,
    reference: Samples | None = None,
    spare: int = 3 * LEAST_SPARE,
    at_rest: bool = False,
) -> Curve:
    """(n,) at `frequencies_hz`, from (samples,) each: the sweep with what leads in and out.

    Each is fitted to the 2·(ORDER + 1) + `spare` lines around it, 1/length apart. `at_rest` says that the record
    begins and ends so, at whatever level; without it the gain is NaN where the transient cannot be told. Raises
    ValueError where `spare` is too small or the record has not that many lines.
    """
    unknowns = 2 * (ORDER + 1)
    width = unknowns + spare
    size = len(input)
    if spare < LEAST_SPARE or size // 2 <= width:
        raise ValueError(f"{size} samples and {spare} lines to spare are not enough")
    excitation = input if reference is None else reference
    records = np.array([excitation, input, output], np.float64)
    spectra = np.fft.rfft(records) / size
    at = np.asarray(frequencies_hz) * size * period_s  # in lines
    first = np.clip(np.round(at - (width - 1) / 2).astype(np.int64), 1, size // 2 - width)
    found: list[_Local] = []
    for place, begin in zip(at, first, strict=True):
        lines = np.arange(begin, begin + width)
        powers = ((lines - place) / width)[:, None] ** np.arange(ORDER + 1)
        near = spectra[:, begin : begin + width]
        step = _step_of_rests(records, lines) if at_rest else None
        found.append(_local(near, powers, step))
    gain, variance, coherence, left = map(np.array, zip(*found, strict=True))
    return Curve(np.asarray(frequencies_hz), gain, variance, left.astype(np.float64), coherence)


def _step_of_rests(records: Array, lines: npt.NDArray[np.int64]) -> Complex:
    """(channels, lines): what it does to the lines that the record ends at another level than it begins."""
    size = records.shape[1]
    rest = min(REST_TICKS, size // 2)
    higher = records[:, -rest:].mean(axis=1) - records[:, :rest].mean(axis=1)
    turn = np.exp(-2j * np.pi * lines / size)
    return np.asarray(higher[:, None] / (1 - turn) / size)


def _local(near: Complex, powers: Array, step: Complex | None) -> _Local:
    """The response from the lines (3, width) of excitation, input and output around a frequency."""
    whole, leverage = _fitted(near, np.hstack([powers * near[0][:, None], powers]))
    rested = near if step is None else near + step
    lone, lone_leverage = _fitted(rested, powers * rested[0][:, None])
    if leverage <= MOST_CONFOUNDED * lone_leverage:
        return whole
    return lone if step is not None else whole._replace(gain=complex(np.nan))


def _fitted(near: Complex, design: Complex) -> tuple[_Local, float]:
    """With how far noise of the lines moves the gain, the first column being that of the response."""
    _, *pair = near
    scale = np.linalg.norm(design, axis=0)
    inverse = np.linalg.pinv(design / scale, rcond=1e-12)
    found = (inverse @ np.array(pair).T) / scale[:, None]
    to_input, to_output = found[0]
    gain = to_output / to_input
    left = pair[1] - gain * pair[0]
    left = left - design @ ((inverse @ left) / scale)
    lines = design.shape[0] - design.shape[1]
    power = float(np.vdot(left, left).real) / lines
    leverage = float(np.linalg.norm(inverse[0] / scale[0]))
    variance = power * leverage**2 / abs(to_input) ** 2
    explained = abs(gain) ** 2 * float(np.mean(np.abs(pair[0]) ** 2))
    return _Local(complex(gain), variance, explained / (explained + power), lines), leverage
