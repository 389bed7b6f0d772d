"""What is added up over ticks, whichever they are: errors, peaks, saturation, likeness."""

import math
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Kind
from app.analysis.walk import Part
from rtcore.compiled import Array, entry, inlined

SATURATED_WITHIN = 1e-6

_TICKS, _ERROR_SQ, _SATURATED, _SLIP, _SLOPE_SQ, _FIT_TICKS, _FIT_SQ = range(7)
_ERROR, _FORCE, _DISPLACEMENT, _VELOCITY, _FIT_FORCE = range(5)


@dataclass
class Tally:
    """Sums and peaks over ticks. Tallies add; a NaN among what was measured stays."""

    sums: Array = field(default_factory=lambda: np.zeros(7))
    peaks: Array = field(default_factory=lambda: np.zeros(5))

    def add(self, other: "Tally") -> None:
        """Count another's ticks too."""
        self.sums += other.sums
        np.maximum(self.peaks, other.peaks, out=self.peaks)

    @property
    def ticks(self) -> int:
        """How many ticks it is over."""
        return int(self.sums[_TICKS])

    @property
    def error_rms_n(self) -> float | None:
        return math.sqrt(self.sums[_ERROR_SQ] / self.ticks) if self.ticks else None

    @property
    def error_peak_n(self) -> float | None:
        return self._peak(_ERROR)

    @property
    def force_peak_n(self) -> float | None:
        return self._peak(_FORCE)

    @property
    def displacement_peak_m(self) -> float | None:
        return self._peak(_DISPLACEMENT)

    @property
    def velocity_peak_m_s(self) -> float | None:
        return self._peak(_VELOCITY)

    @property
    def saturation_share(self) -> float | None:
        """Share of the ticks in which the valve command was at its limit."""
        return float(self.sums[_SATURATED] / self.ticks) if self.ticks else None

    @property
    def delay_ticks(self) -> float | None:
        """By how much the setpoint, moved later, follows the force best: least squares, first order."""
        slope = self.sums[_SLOPE_SQ]
        return float(self.sums[_SLIP] / slope) if slope > 0 else None

    @property
    def goodness_percent(self) -> float | None:
        """G of the paper, eq. (4), against the reference; as `app.analysis.goodness` has it."""
        ticks, peak_n = self.sums[_FIT_TICKS], self.peaks[_FIT_FORCE]
        if ticks == 0:
            return None
        if not peak_n > 0:
            return math.nan
        return float(100 * (1 - math.sqrt(self.sums[_FIT_SQ] / ticks) / peak_n))

    @property
    def goodness_peak_n(self) -> float | None:
        """The peak of the force that G is normalised by: where there was something to compare with."""
        return float(self.peaks[_FIT_FORCE]) if self.sums[_FIT_TICKS] else None

    def _peak(self, which: int) -> float | None:
        return float(self.peaks[which]) if self.ticks else None


class Tallying:
    """Makes tallies, part after part: a slope reaches from one part to the next."""

    def __init__(self, valve_limit: float) -> None:
        self._saturated_from = valve_limit - SATURATED_WITHIN
        self._before = np.zeros(3)  # position, setpoint and error of the tick before

    def of(self, part: Part, reference_n: Array | None) -> Tally:
        """The tally of a part; `reference_n` (n,) is NaN where there is none."""
        made = Tally()
        c = part.columns
        if part.begins:
            self._before[:] = -2.0, 0.0, 0.0
        other = np.full(len(part.positions), np.nan) if reference_n is None else reference_n
        _add_up(
            made.sums,
            made.peaks,
            self._before,
            part.positions,
            c["force_command_n"],
            c["force_n"],
            c["force_error_n"],
            c["displacement_m"],
            c["velocity_m_s"],
            c["valve_command"],
            self._saturated_from,
            np.where(part.in_phase, other, np.nan),
        )
        if part.stretch.kind not in (Kind.COURSE, Kind.SWEEP):
            made.sums[[_SLIP, _SLOPE_SQ]] = 0.0  # of a jump there is no slope, of a sine a phase
        return made


Single = npt.NDArray[np.float32]


@inlined
def _raise(peaks: Array, which: int, value: float) -> None:
    """A NaN is a peak that nothing exceeds."""
    if not np.isnan(peaks[which]) and not (abs(value) <= peaks[which]):
        peaks[which] = abs(value)


@entry
def _add_up(
    sums: Array,
    peaks: Array,
    before: Array,
    positions: npt.NDArray[np.int64],
    command: Single,
    force: Single,
    error: Single,
    displacement: Single,
    velocity: Single,
    valve: Single,
    saturated_from: float,
    reference: Array,
) -> None:
    n = len(force)
    sums[_TICKS] += n
    for i in range(n):
        sums[_ERROR_SQ] += np.float64(error[i]) * np.float64(error[i])
        _raise(peaks, _ERROR, np.float64(error[i]))
        _raise(peaks, _FORCE, np.float64(force[i]))
        _raise(peaks, _DISPLACEMENT, np.float64(displacement[i]))
        _raise(peaks, _VELOCITY, np.float64(velocity[i]))
        if abs(np.float64(valve[i])) >= saturated_from:
            sums[_SATURATED] += 1
        if positions[i] == before[0] + 1:
            slope = np.float64(command[i]) - before[1]
            sums[_SLIP] += 0.5 * (np.float64(error[i]) + before[2]) * slope
            sums[_SLOPE_SQ] += slope * slope
        before[0] = positions[i]
        before[1] = np.float64(command[i])
        before[2] = np.float64(error[i])
        if not np.isnan(reference[i]):
            apart = np.float64(force[i]) - reference[i]
            sums[_FIT_TICKS] += 1
            sums[_FIT_SQ] += apart * apart
            _raise(peaks, _FIT_FORCE, np.float64(force[i]))
