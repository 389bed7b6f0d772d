"""The error budget of a dynamic force: what is not known of the force on the unit, and from where.

After the idea of ISO 4965-1: the force that matters is that on the unit, the inertia between it and the load
cell is part of the error, and errors are told as a share of the range that the force went through. Each
contribution is a standard uncertainty at any one instant of the run; they are independent and add in squares
(GUM, JCGM 100). How well the force was measured and how well it was controlled are two things, kept apart.
"""

import math
from enum import StrEnum
from typing import NamedTuple

from app.analysis.dynamics import Dynamics
from app.analysis.unit_force import Chain, noise_gains
from rtcore.rig.parameters import RigParameters

COVERAGE = 2.0  # about 95 %
RATED_N = 50_000.0


class Shape(StrEnum):
    """Of a distribution."""

    NORMAL = "normal"
    RECTANGULAR = "rectangular"


class Source(StrEnum):
    """How a contribution was got."""

    DATA_SHEET = "data sheet"
    MEASURED = "measured in this run"
    ASSUMED = "assumed"
    CALCULATED = "calculated"


_DIVISOR = {Shape.NORMAL: 1.0, Shape.RECTANGULAR: math.sqrt(3.0)}


class Known(NamedTuple):
    """How well the rig itself is known: half widths. Where nobody has measured better, these are assumed."""

    load_cell_n: float = 125.0
    load_cell_from: str = "the rig's data sheet: 0.25 % of 50 kN"
    masses_share: float = 0.01
    velocity_share: float = 0.01
    stiffness_share: float = 0.05
    chain_share: float = 0.05  # of the load cell's delay


class Contribution(NamedTuple):
    """One of the budget: `value_n` is what was found or is stated, `standard_n` what of it counts.

    `of_unit` says that it comes with the correction for inertia, and not with the load cell's reading.
    """

    name: str
    value_n: float
    shape: Shape
    standard_n: float
    source: Source
    how: str
    of_unit: bool = False


class Measured(NamedTuple):
    """How well the force was measured. Expanded uncertainties have the factor `COVERAGE`.

    `range_n` is what the force on the unit went through. The load cell tells of a force `delay_s` later.
    """

    contributions: tuple[Contribution, ...]
    cell_expanded_n: float
    unit_expanded_n: float
    range_n: float
    share_of_range_percent: float | None
    share_of_rated_percent: float
    unit_highest_n: float
    unit_lowest_n: float
    inertia_rms_n: float
    inertia_peak_n: float
    delay_s: float


class Controlled(NamedTuple):
    """How well the force was controlled: setpoint less load cell, and less the force on the unit.

    Over every tick of the run; what the one tick from reading to valve costs is in it.
    """

    error_rms_n: float
    error_peak_n: float
    unit_error_rms_n: float
    unit_error_peak_n: float
    share_of_range_percent: float | None


def measured(
    found: Dynamics, rig: RigParameters, period_s: float, known: Known | None = None
) -> Measured:
    """The budget of what was measured of a run."""
    parts = _contributions(found, rig, period_s, known or Known())
    cell_n = math.hypot(*(part.standard_n for part in parts if not part.of_unit))
    unit_n = math.hypot(*(part.standard_n for part in parts))
    low_n, high_n = (found.unit_n.low, found.unit_n.high) if found.unit_n.count else (0.0, 0.0)
    return Measured(
        parts,
        COVERAGE * cell_n,
        COVERAGE * unit_n,
        high_n - low_n,
        _share(COVERAGE * unit_n, high_n - low_n),
        100 * COVERAGE * unit_n / RATED_N,
        high_n,
        low_n,
        found.inertia_n.rms,
        found.inertia_n.peak,
        _delay_s(rig),
    )


def controlled(found: Dynamics) -> Controlled:
    """What became of the setpoint."""
    error, unit = found.error_n, found.unit_error_n
    range_n = found.unit_n.high - found.unit_n.low if found.unit_n.count else 0.0
    share = _share(unit.rms, range_n)
    return Controlled(error.rms, error.peak, unit.rms, unit.peak, share)


def _contributions(
    found: Dynamics, rig: RigParameters, period_s: float, known: Known
) -> tuple[Contribution, ...]:
    return (*_of_the_cell(found, rig, known), *_of_the_inertia(found, rig, period_s, known))


def _of_the_cell(found: Dynamics, rig: RigParameters, known: Known) -> list[Contribution]:
    sensors, slope_n_s = rig.sensors, found.slope_n_s.rms
    step_n = 2 * sensors.force_range_n / 2**sensors.bits
    jitter_s = found.latency_s.deviation or 0.0
    delay_s = _delay_s(rig)
    share = abs(_chain_gain(rig, found.frequency_hz) - 1)
    return [
        _part(
            "Load cell's class",
            known.load_cell_n,
            Shape.RECTANGULAR,
            Source.DATA_SHEET,
            f"±{known.load_cell_n:.3g} N, {known.load_cell_from}",
        ),
        _part(
            "Noise of the load cell",
            found.force_noise_n,
            Shape.NORMAL,
            Source.MEASURED,
            "1 sigma of a single reading, from sixth differences of the force",
        ),
        _part(
            "Steps of the converter",
            0.5 * step_n,
            Shape.RECTANGULAR,
            Source.CALCULATED,
            f"half a step of {step_n:.3g} N: {sensors.bits} bits over ±{sensors.force_range_n / 1000:.0f} kN",
        ),
        _part(
            "Jitter of sampling",
            jitter_s * slope_n_s,
            Shape.NORMAL,
            Source.MEASURED,
            f"wake-up latencies deviate by {1e6 * jitter_s:.2g} µs; the force changes by "
            f"{slope_n_s / 1000:.3g} kN/s (rms)",
        ),
        _part(
            "Delay of the load cell's chain",
            known.chain_share * delay_s * slope_n_s,
            Shape.RECTANGULAR,
            Source.ASSUMED,
            f"{1e6 * delay_s:.0f} µs are known to ±{100 * known.chain_share:.0f} %",
        ),
        _part(
            "Gain of the load cell's chain",
            share * (found.cell_n.deviation or 0.0),
            Shape.RECTANGULAR,
            Source.CALCULATED,
            f"{100 * share:.2g} % at {found.frequency_hz:.0f} Hz, not corrected",
        ),
    ]


def _of_the_inertia(
    found: Dynamics, rig: RigParameters, period_s: float, known: Known
) -> list[Contribution]:
    chain, inertia_n = Chain.of(rig), found.inertia_n.rms
    of_force, of_velocity = noise_gains(chain, period_s)
    noise_n = math.hypot(of_force * found.force_noise_n, of_velocity * found.velocity_noise_m_s)
    plate_n = chain.mass_kg / chain.plate_n_m * _bend(found)
    return [
        _part(
            "Masses between load cell and unit",
            known.masses_share * inertia_n,
            Shape.RECTANGULAR,
            Source.ASSUMED,
            f"{chain.mass_kg:.3g} kg to ±{100 * known.masses_share:.0f} %, of {inertia_n:.3g} N (rms)",
            of_unit=True,
        ),
        _part(
            "Velocity that their acceleration is from",
            known.velocity_share * inertia_n,
            Shape.RECTANGULAR,
            Source.ASSUMED,
            f"the transducer's gain to ±{100 * known.velocity_share:.0f} %",
            of_unit=True,
        ),
        _part(
            "Plate under the load actuator",
            known.stiffness_share * plate_n,
            Shape.RECTANGULAR,
            Source.ASSUMED,
            f"its stiffness to ±{100 * known.stiffness_share:.0f} %; its swing takes {plate_n:.3g} N (rms)",
            of_unit=True,
        ),
        _part(
            "Noise of the correction",
            noise_n,
            Shape.NORMAL,
            Source.MEASURED,
            "noise of velocity and force, as the correction lets it through",
            of_unit=True,
        ),
    ]


def _part(
    name: str, value_n: float, shape: Shape, source: Source, how: str, *, of_unit: bool = False
) -> Contribution:
    return Contribution(name, value_n, shape, value_n / _DIVISOR[shape], source, how, of_unit)


def _bend(found: Dynamics) -> float:
    """(2πf)²·F, rms, N/s²: what a compliance makes an acceleration of."""
    return (2 * math.pi * found.frequency_hz) * found.slope_n_s.rms


def _delay_s(rig: RigParameters) -> float:
    """How much later than the force the load cell's chain reads it, well below its own frequency."""
    return 2 * rig.sensors.zeta_lc / rig.sensors.omega_lc_rad_s


def _chain_gain(rig: RigParameters, frequency_hz: float) -> float:
    r = 2 * math.pi * frequency_hz / rig.sensors.omega_lc_rad_s
    return 1 / math.hypot(1 - r * r, 2 * rig.sensors.zeta_lc * r)


def _share(value_n: float, range_n: float) -> float | None:
    return 100 * value_n / range_n if range_n > 0 else None
