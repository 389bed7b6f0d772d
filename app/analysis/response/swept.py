"""Frequency response of a sweep, or of any excitation: the local polynomial method.

The spectrum of the whole sweep is taken at once, so nothing is assumed of how slowly it goes. Around each
frequency response and transient are smooth, so output = G(f)·U + T(f) with a parabola each is fitted to
the lines nearby, and what does not fit is the noise (Pintelon, Schoukens, Vandersteen and Barbé, Mech.
Syst. Signal Process. 24, 2010). With a reference both channels are fitted against it and divided: noise
that a closed loop feeds back is then no part of the response.
"""

import numpy as np
import numpy.typing as npt

from app.analysis.phasors import Complex
from app.analysis.response.curve import Curve
from rtcore.compiled import Array

Samples = npt.NDArray[np.floating]
ORDER = 2  # of the polynomials
LEAST_SPARE = 6  # lines more than unknowns


def swept_response(
    input: Samples,
    output: Samples,
    period_s: float,
    frequencies_hz: Array,
    *,
    reference: Samples | None = None,
    spare: int = 3 * LEAST_SPARE,
) -> Curve:
    """(n,) at `frequencies_hz`, from (samples,) each: the sweep with what leads in and out.

    Each is fitted to the 2·(ORDER + 1) + `spare` lines around it, 1/length apart. Raises ValueError where
    `spare` is too small or the record has not that many lines.
    """
    unknowns = 2 * (ORDER + 1)
    width = unknowns + spare
    size = len(input)
    if spare < LEAST_SPARE or size // 2 <= width:
        raise ValueError(f"{size} samples and {spare} lines to spare are not enough")
    excitation = input if reference is None else reference
    spectra = np.fft.rfft(np.array([excitation, input, output], np.float64)) / size
    at = np.asarray(frequencies_hz) * size * period_s  # in lines
    first = np.clip(np.round(at - (width - 1) / 2).astype(np.int64), 1, size // 2 - width)
    gain, variance, coherence = np.empty((3, len(at)), np.complex128)
    for i, begin in enumerate(first):
        near = spectra[:, begin : begin + width]
        offsets = (np.arange(begin, begin + width) - at[i]) / width
        gain[i], variance[i], coherence[i] = _local(near, offsets, spare)
    lines = np.full(len(at), float(spare))
    return Curve(np.asarray(frequencies_hz), gain, variance.real, lines, coherence.real)


def _local(near: Complex, offsets: Array, spare: int) -> tuple[complex, float, float]:
    """Gain, its variance and coherence, from the lines (3, width) of excitation, input and output."""
    excitation, *pair = near
    powers = offsets[:, None] ** np.arange(ORDER + 1)
    design = np.hstack([powers * excitation[:, None], powers])
    scale = np.linalg.norm(design, axis=0)
    inverse = np.linalg.pinv(design / scale, rcond=1e-12)
    found = (inverse @ np.array(pair).T) / scale[:, None]
    to_input, to_output = found[0]
    gain = to_output / to_input
    left = pair[1] - gain * pair[0]
    left = left - design @ ((inverse @ left) / scale)
    power = float(np.vdot(left, left).real) / spare
    leverage = float(np.linalg.norm(inverse[0] / scale[0]) ** 2)
    variance = power * leverage / abs(to_input) ** 2
    explained = abs(gain) ** 2 * float(np.mean(np.abs(pair[0]) ** 2))
    return complex(gain), variance, explained / (explained + power)
