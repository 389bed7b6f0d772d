"""Numbers as sheets give them."""

import math

import numpy as np
import numpy.typing as npt

from app.analysis.response.extremes import Extreme
from app.analysis.response.margins import Margins
from app.sheets.asked import Band
from app.sheets.schemas import Curve, LoopExtreme, LoopResponse, MarginsOut

Floats = npt.NDArray[np.float64]
Complexes = npt.NDArray[np.complex128]
LEAST_GAIN = 1e-12  # -240 dB: what a notch has at its centre


def grid(band: Band) -> Floats:
    """(points,) frequencies, Hz."""
    return np.geomspace(band.from_hz, band.to_hz, band.points)


def number(value: float) -> float | None:
    """Null for what is no number."""
    return float(value) if math.isfinite(value) else None


def curve(values: Floats) -> Curve:
    """An array as a list."""
    return [number(value) for value in values]


def in_db(values: Complexes | Floats) -> Floats:
    """Gain in dB; what is nothing at all as -240 dB."""
    return np.asarray(20.0 * np.log10(np.maximum(np.abs(values), LEAST_GAIN)))


def response(values: Complexes) -> LoopResponse:
    """Gain, and phase without jumps of 360°."""
    phase = np.degrees(np.unwrap(np.angle(values)))
    return LoopResponse(gain_db=curve(in_db(values)), phase_deg=curve(phase))


def extreme(found: Extreme | None) -> LoopExtreme | None:
    """A peak or a dip, null where there is none."""
    return found and LoopExtreme(frequency_hz=found.frequency_hz, gain_db=found.gain_db)


def margins_out(found: Margins) -> MarginsOut:
    """Margins, null where there are none."""
    return MarginsOut(
        crossover_hz=number(found.crossover_hz),
        phase_margin_deg=number(found.phase_deg),
        gain_margin_db=number(found.gain_db),
        worst_sensitivity=found.worst_sensitivity,
        turnover_hz=number(found.turnover_hz),
    )
