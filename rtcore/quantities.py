"""What detectors watch: measured, or derived from what was measured in this tick and before."""

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.interlocks import Quantity

RECENT_S = 0.5  # over which a peak is remembered
RECENT_SATURATION_S = 0.25
ROLLING_S = 1.0  # of the goodness of fit
LEAST_PEAK_N = 1000.0  # errors are not compared with less
AT_LIMIT = 0.98  # of the valve's limit

OBSERVED = np.dtype(
    [
        ("quantities", "f8", (len(Quantity),)),
        ("command_peak_n", "f8"),  # that of the last time, fading
        # of the cycle that goes on
        ("cycle", "i8"),
        ("block", "i8"),
        ("command_low_n", "f8"),
        ("command_high_n", "f8"),
        ("force_low_n", "f8"),
        ("force_high_n", "f8"),
        ("cycles", "i8"),  # of the run
        ("saturated", "f8"),
        ("twin_force_n", "f8"),  # of the virtual rig beside this one, in this tick
        ("twin_spool", "f8"),
        ("has_twin", "i8"),
        ("twin_square_n2", "f8"),
        ("force_peak_n", "f8"),
    ],
    align=True,
)


@kernel
def fading_peak(peak: float, value: float, period_s: float, over_s: float) -> float:
    """The largest magnitude of late, fading with a time constant of `over_s`."""
    return max(abs(value), peak * (1.0 - period_s / over_s))


@kernel
def begin_cycle(o: Record, core: Record) -> None:
    """Look at the swing of a new cycle."""
    o.command_low_n = o.command_high_n = core.force.value
    o.force_low_n = o.force_high_n = core.sample.force_n


@kernel
def watch_cycle(o: Record, core: Record) -> None:
    """Count the cycles of the run; of a completed one, by how much the swing of the force fell short."""
    completed = core.force.cycle - o.cycle
    o.cycle = core.force.cycle
    if core.run == 0:
        o.cycles = 0
    if core.force.block != o.block or core.force.frequency_hz == 0.0:
        o.block = core.force.block
        o.quantities[Quantity.UNDERPEAK] = 0.0
        begin_cycle(o, core)
    elif completed > 0:
        o.cycles += completed
        swing_n = o.command_high_n - o.command_low_n
        short_n = swing_n - (o.force_high_n - o.force_low_n)
        o.quantities[Quantity.UNDERPEAK] = short_n / swing_n if swing_n > 0.0 else 0.0
        begin_cycle(o, core)
    o.command_low_n = min(o.command_low_n, core.force.value)
    o.command_high_n = max(o.command_high_n, core.force.value)
    o.force_low_n = min(o.force_low_n, core.sample.force_n)
    o.force_high_n = max(o.force_high_n, core.sample.force_n)
    o.quantities[Quantity.CYCLES] = o.cycles


@kernel
def watch_valve(o: Record, valve_command: float, valve_limit: float, period_s: float) -> None:
    """How much of the last time the valve was at its limit."""
    saturated = 1.0 if not (abs(valve_command) < AT_LIMIT * valve_limit) else 0.0
    o.saturated += period_s / RECENT_SATURATION_S * (saturated - o.saturated)
    o.quantities[Quantity.VALVE_COMMAND] = valve_command
    o.quantities[Quantity.VALVE_SATURATION] = o.saturated


@kernel
def watch_twin(o: Record, force_n: float, spool: float, period_s: float) -> None:
    """Residuals, and rolling G (paper eq. 4): root of the mean square of that of the force over its peak."""
    if o.has_twin == 0:
        o.quantities[Quantity.TWIN_RESIDUAL_N] = 0.0
        o.quantities[Quantity.TWIN_SPOOL] = 0.0
        o.quantities[Quantity.TWIN_GOODNESS] = 100.0
        return
    residual_n = force_n - o.twin_force_n
    share = period_s / ROLLING_S
    if not np.isfinite(o.twin_square_n2):
        o.twin_square_n2 = 0.0  # what was no number has been told; it is not to stay
    if not np.isfinite(o.force_peak_n):
        o.force_peak_n = 0.0
    o.twin_square_n2 += share * (residual_n * residual_n - o.twin_square_n2)
    o.force_peak_n = fading_peak(o.force_peak_n, force_n, period_s, ROLLING_S)
    peak_n = max(o.force_peak_n, LEAST_PEAK_N)
    o.quantities[Quantity.TWIN_RESIDUAL_N] = residual_n
    o.quantities[Quantity.TWIN_SPOOL] = spool - o.twin_spool
    o.quantities[Quantity.TWIN_GOODNESS] = 100.0 * (1.0 - np.sqrt(o.twin_square_n2) / peak_n)


@kernel
def observe(
    core: Record, valve_limit: float, silence_s: float, missed: int, unrecorded_s: float
) -> None:
    """Gather what the detectors watch in this tick. Setpoints and valve are those of the tick before."""
    o = core.observed
    q, sample, inputs = o.quantities, core.sample, core.inputs
    period_s = core.settings.period_s
    error_n = core.force.value - sample.force_n
    o.command_peak_n = fading_peak(o.command_peak_n, core.force.value, period_s, RECENT_S)
    q[Quantity.FORCE_N] = sample.force_n
    q[Quantity.FORCE_ERROR_N] = error_n
    q[Quantity.FORCE_ERROR_RELATIVE] = abs(error_n) / max(o.command_peak_n, LEAST_PEAK_N)
    q[Quantity.DISPLACEMENT_M] = sample.displacement_m
    q[Quantity.DISPLACEMENT_ERROR_M] = core.motion.value - sample.displacement_m
    q[Quantity.VELOCITY_M_S] = sample.velocity_m_s
    q[Quantity.SUPPLY_PRESSURE_PA] = inputs.supply_pressure_pa
    q[Quantity.PRESSURE_1_PA] = inputs.pressure_1_pa
    q[Quantity.PRESSURE_2_PA] = inputs.pressure_2_pa
    q[Quantity.LOAD_CELL] = sample.force.fault
    q[Quantity.LVT] = sample.velocity.fault
    q[Quantity.LVDT] = sample.displacement.fault
    q[Quantity.PRESSURE_SENSOR] = sample.pressure.fault
    q[Quantity.CHAIN_OPEN] = 0.0 if inputs.chain == 1 else 1.0
    q[Quantity.APP_SILENCE_S] = silence_s
    q[Quantity.DEADLINES_MISSED] = missed
    q[Quantity.UNRECORDED_S] = unrecorded_s
    watch_cycle(o, core)
    watch_valve(o, core.outputs.valve_command, valve_limit, period_s)
    watch_twin(o, sample.force_n, inputs.spool_position, period_s)
