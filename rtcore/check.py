"""Check: every detector of the table, every tick; what trips is latched, and the first to trip is kept."""

import numpy as np

from rtcore.codes import EventKind
from rtcore.compiled import Record, kernel
from rtcore.interlocks import NO_ACTION, Quantity, check_detector
from rtcore.memory.rings import publish_event

_FORCE, _ERROR = int(Quantity.FORCE_N), int(Quantity.FORCE_ERROR_N)
_DISPLACEMENT, _VELOCITY = int(Quantity.DISPLACEMENT_M), int(Quantity.VELOCITY_M_S)
_SUPPLY, _FAULTS = int(Quantity.SUPPLY_PRESSURE_PA), int(Quantity.SENSOR_FAULTS)
_SILENCE, _MISSED = int(Quantity.APP_SILENCE_S), int(Quantity.DEADLINES_MISSED)
_TRIP = int(EventKind.TRIP)
_ONE = np.uint64(1)


@kernel
def collect_quantities(core: Record, silence_s: float, missed: int) -> None:
    """Gather what the detectors watch."""
    q = core.quantities
    q[_FORCE] = core.sample.force_n
    q[_ERROR] = core.force.value - core.sample.force_n
    q[_DISPLACEMENT] = core.sample.displacement_m
    q[_VELOCITY] = core.sample.velocity_m_s
    q[_SUPPLY] = core.inputs.supply_pressure_pa
    q[_FAULTS] = core.sample.faults
    q[_SILENCE] = silence_s
    q[_MISSED] = missed


@kernel
def check_detectors(table: Record, core: Record, block: Record, block_address: int) -> int:
    """Evaluate the table; returns the strongest action of those that trip in this tick, or `NO_ACTION`."""
    strongest = NO_ACTION
    core.violated = np.uint64(0)
    for i in range(table.count):
        detector = table.detectors[i]
        value = core.quantities[detector.quantity]
        ticks = check_detector(detector, value, core.mode, core.violated_ticks[i])
        core.violated_ticks[i] = ticks
        if ticks < detector.persistence_ticks:
            continue
        bit = _ONE << np.uint64(i)
        core.violated |= bit
        if core.trips & bit:
            continue
        core.trips |= bit
        if block.first_out < 0:
            block.first_out = i
        publish_event(block_address, core.tick, _TRIP, i, value, detector.threshold)
        strongest = max(strongest, detector.action)
    return strongest
