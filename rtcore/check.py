"""Check: every detector of the table, every tick; what trips is latched, and the first to trip is kept."""

import numpy as np

from rtcore.codes import EventKind
from rtcore.compiled import Record, kernel
from rtcore.interlocks import NO_ACTION, Quantity, check_detector
from rtcore.memory.rings import publish_event

_ONE = np.uint64(1)


@kernel
def collect_quantities(core: Record, silence_s: float, missed: int) -> None:
    """Gather what the detectors watch."""
    q = core.quantities
    q[Quantity.FORCE_N] = core.sample.force_n
    q[Quantity.FORCE_ERROR_N] = core.force.value - core.sample.force_n
    q[Quantity.DISPLACEMENT_M] = core.sample.displacement_m
    q[Quantity.VELOCITY_M_S] = core.sample.velocity_m_s
    q[Quantity.SUPPLY_PRESSURE_PA] = core.inputs.supply_pressure_pa
    q[Quantity.SENSOR_FAULTS] = core.sample.faults
    q[Quantity.APP_SILENCE_S] = silence_s
    q[Quantity.DEADLINES_MISSED] = missed


@kernel
def check_detectors(table: Record, core: Record, block: Record, block_address: int) -> int:
    """Evaluate the table; returns the strongest action that is called for, or `NO_ACTION`."""
    strongest = NO_ACTION
    core.violated = np.uint64(0)
    if core.has_interlocks == 0:
        return strongest
    for i in range(table.count):
        detector = table.detectors[i]
        value = core.quantities[detector.quantity]
        ticks = check_detector(detector, value, core.mode, core.violated_ticks[i])
        core.violated_ticks[i] = ticks
        if ticks < detector.persistence_ticks:
            continue
        bit = _ONE << np.uint64(i)
        core.violated |= bit
        strongest = max(strongest, detector.action)
        if core.trips & bit:
            continue
        core.trips |= bit
        if block.first_out < 0:
            block.first_out = i
        publish_event(block_address, core.tick, EventKind.TRIP, i, value, detector.threshold)
    return strongest
