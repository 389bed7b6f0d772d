"""What an analysis of a run tells; null stands where there is no number."""

import math
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict

from app.analysis.uncertainty import Shape, Source

VERSION = 3  # of what is kept: one of another version is computed anew
BEFORE = 2  # which was wrong of runs of which something had been skipped, and of no others


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


Number = Annotated[float | None, BeforeValidator(_finite)]


class _Read(BaseModel):
    """Read off what the analysis made."""

    model_config = ConfigDict(from_attributes=True)


class SpreadOut(_Read):
    """Of a value over cycles; the deviation of fewer than two is null."""

    count: int
    mean: Number
    deviation: Number
    low: Number
    high: Number


class SineOut(_Read):
    """A sine as it was asked for."""

    frequency_hz: float
    amplitude_n: float
    mean_n: float


class HarmonicOut(_Read):
    """A multiple of the sine's frequency; `percent` is of the first, the phase against the setpoint's."""

    order: int
    amplitude_n: Number
    phase_deg: Number
    percent: Number


class LayerOut(_Read):
    """A layer: one sine of a block, or a sweep, of which nothing is fitted.

    Errors are what was above (+) or below (−) what was asked for. Spreads are over the whole cycles.
    """

    block: int
    asked: SineOut | None
    cycles: int
    amplitude_n: Number
    mean_n: Number
    phase_deg: Number
    amplitude_error_percent: Number
    mean_error_n: Number
    distortion_percent: Number
    peak_n: SpreadOut
    valley_n: SpreadOut
    cycle_mean_n: SpreadOut
    range_n: SpreadOut
    harmonics: list[HarmonicOut]


class StepOut(_Read):
    """A step of the setpoint and the response to it; null where it did not get that far."""

    block: int
    time_s: float  # of the program
    begin_n: float
    end_n: float
    dead_time_s: Number
    rise_s: Number
    overshoot_percent: Number
    settling_s: Number
    steady_error_n: Number


class UnitOut(_Read):
    """The unit under test as slow cycles that push and pull show it; deviations are from cycle to cycle.

    `hysteresis_j` is the energy that it loses in a cycle, `backlash_m` its free play.
    """

    block: int
    asked: SineOut
    cycles: int
    stiffness_n_m: Number
    stiffness_std_n_m: Number
    hysteresis_j: Number
    hysteresis_std_j: Number
    backlash_m: Number


class LikenessOut(_Read):
    """G of the paper's eq. (4) against the prediction, normalised by the force's peak."""

    percent: Number
    peak_n: Number
    rms_n: Number


class RangeClassOut(_Read):
    """Cycles with a range from `from_n` to before `to_n`: asked for and applied. Half cycles count 0.5."""

    from_n: float
    to_n: float
    asked: float
    applied: float


class MatrixCellOut(_Read):
    """Cycles that were applied, by the lower ends of their classes of range and mean."""

    range_n: float
    mean_n: float
    cycles: float


class RainflowOut(_Read):
    """Cycles by rainflow counting, of the load cell over every tick and of its setpoint."""

    gate_n: float
    class_n: float
    asked_cycles: float
    applied_cycles: float
    asked_largest_range_n: float
    applied_largest_range_n: float
    spectrum: list[RangeClassOut]
    matrix: list[MatrixCellOut]


class DamageOut(_Read):
    """By a Wöhler exponent; the amplitudes do in `cycles` cycles the damage asked for and applied."""

    exponent: float
    cycles: float
    asked_amplitude_n: float
    applied_amplitude_n: float
    ratio: Number


class ContributionOut(_Read):
    """One contribution to the error budget; `of_unit` says that it comes with the inertia's correction."""

    name: str
    value_n: float
    shape: Shape
    standard_n: float
    source: Source
    how: str
    of_unit: bool


class UncertaintyOut(_Read):
    """How well the force was measured, at any instant; expanded uncertainties have the factor `coverage`."""

    coverage: float
    contributions: list[ContributionOut]
    cell_expanded_n: float
    unit_expanded_n: float
    range_n: float
    share_of_range_percent: Number
    share_of_rated_percent: float
    unit_highest_n: float
    unit_lowest_n: float
    inertia_rms_n: float
    inertia_peak_n: float
    delay_s: float


class ControlOut(_Read):
    """How well the force was controlled: setpoint less load cell, and less the force on the unit."""

    error_rms_n: float
    error_peak_n: float
    unit_error_rms_n: float
    unit_error_peak_n: float
    share_of_range_percent: Number


class RunAnalysis(BaseModel):
    """A run in the time domain. Long lists are cut; `layers_in_all` and `steps_in_all` say how long they were."""

    version: int = VERSION
    layers: list[LayerOut]
    layers_in_all: int
    steps: list[StepOut]
    steps_in_all: int
    unit: list[UnitOut]
    goodness: LikenessOut | None
    rainflow: RainflowOut
    damage: list[DamageOut]
    uncertainty: UncertaintyOut
    control: ControlOut
