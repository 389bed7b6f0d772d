"""Frequency response by averaged spectra (H1, H2, Hv) of any excitation: segments, coherence, intervals.

An estimator is a choice of what the averages are taken against: H = S_yw/S_uw. Against the input (H1)
noise on the output averages out, against the output (H2) noise on the input does, against a reference
(the setpoint, in a closed loop) both do. Hv is the geometric mean of H1 and H2. Intervals: Bendat and
Piersol, Random Data, 4th ed., section 9.2, with the segments' overlap counted.
"""

from enum import Enum

import numpy as np
import numpy.typing as npt
from scipy.signal import get_window

from app.analysis.phasors import Complex
from app.analysis.response.curve import Curve
from rtcore.compiled import Array

Samples = npt.NDArray[np.floating]


class Against(Enum):
    """Where the noise is thought to be."""

    INPUT = "h1"  # on the output
    OUTPUT = "h2"  # on the input
    BOTH = "hv"  # on both
    REFERENCE = "reference"  # on both, and fed back


def spectral_response(
    input: Samples,
    output: Samples,
    period_s: float,
    segment_ticks: int,
    against: Against = Against.INPUT,
    *,
    reference: Samples | None = None,
    window: str = "hann",
    overlap: float = 0.5,
) -> Curve:
    """(segment_ticks // 2 - 1,) of (n,) samples each, at whole multiples of 1/segment.

    For a periodic excitation the segment is its period, the window "boxcar" and the overlap 0. Raises
    ValueError where there are less than two segments, or no reference where one is needed.
    """
    if (against is Against.REFERENCE) != (reference is not None):
        raise ValueError("a reference is given where, and only where, it is averaged against")
    signals = [input, output] if reference is None else [input, output, reference]
    step = max(1, round(segment_ticks * (1 - overlap)))
    weights = np.asarray(get_window(window, segment_ticks))
    spectra, count = _cross_spectra(signals, weights, step)
    if count < 2:
        raise ValueError(f"{len(input)} samples are less than two segments of {segment_ticks}")
    lines = _independent(weights, step, count) - 1
    frequencies_hz = np.arange(1, segment_ticks // 2) / (segment_ticks * period_s)
    return _curve(frequencies_hz, spectra[:, :, 1 : segment_ticks // 2], against, lines)


def _curve(frequencies_hz: Array, s: Complex, against: Against, lines: float) -> Curve:
    """From (channels, channels, n) mean cross spectra S_ab = A·conj(B): input, output, reference."""
    uu, yy, yu = s[0, 0].real, s[1, 1].real, s[1, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        coherence = np.abs(yu) ** 2 / (uu * yy)
        if against is Against.BOTH:
            gain = np.sqrt(yy / uu) * np.exp(1j * np.angle(yu))
            leverage = 1 / (uu * np.sqrt(coherence))
        else:
            w = {Against.INPUT: 0, Against.OUTPUT: 1, Against.REFERENCE: 2}[against]
            gain = s[1, w] / s[0, w]
            leverage = s[w, w].real / np.abs(s[0, w]) ** 2
        left = np.maximum(0.0, yy - 2 * (gain.conj() * yu).real + np.abs(gain) ** 2 * uu)
    variance = left * leverage / lines
    return Curve(frequencies_hz, gain, variance, np.full(len(uu), lines), coherence)


def _cross_spectra(signals: list[Samples], weights: Array, step: int) -> tuple[Complex, int]:
    """(channels, channels, bins) summed over segments, whose means are taken out, and how many."""
    size, total = len(weights), len(signals[0])
    channels = len(signals)
    spectra = np.zeros((channels, channels, size // 2 + 1), np.complex128)
    count = 0
    for begin in range(0, total - size + 1, step):
        parts = np.array([signal[begin : begin + size] for signal in signals], np.float64)
        parts -= parts.mean(axis=1, keepdims=True)
        found = np.fft.rfft(parts * weights)
        spectra += found[:, None] * found[None].conj()
        count += 1
    return spectra / max(1, count), count


def _independent(weights: Array, step: int, count: int) -> float:
    """How many segments without overlap are worth as much (Welch, IEEE Trans. Audio 15, 1967)."""
    power = float(weights @ weights)
    shared = 0.0
    for apart in range(1, count):
        if apart * step >= len(weights):
            break
        likeness = float(weights[apart * step :] @ weights[: -apart * step]) / power
        shared += (1 - apart / count) * likeness**2
    return count / (1 + 2 * shared)
