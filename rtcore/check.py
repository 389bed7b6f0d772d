"""Check: every detector of the table, every tick; what trips is kept, and what took the load off first is known."""

import numpy as np

from rtcore.codes import EventKind
from rtcore.compiled import Record, kernel
from rtcore.interlocks import (
    NO_ACTION,
    Action,
    check_detector,
    judged_value,
    latches,
)
from rtcore.memory.rings import publish_event

_ONE = np.uint64(1)


@kernel
def check_detectors(table: Record, core: Record, block: Record, block_address: int) -> int:
    """Evaluate the table; returns the strongest action that is called for, or `NO_ACTION`."""
    strongest, first = NO_ACTION, -1
    core.violated = np.uint64(0)
    core.acting = np.uint64(0)
    if core.has_interlocks == 0:
        return strongest
    for i in range(table.count):
        detector = table.detectors[i]
        quantity = core.observed.quantities[detector.quantity]
        value = judged_value(detector, core.trends[i], quantity, core.settings.period_s)
        ticks = check_detector(detector, value, core.mode, core.violated_ticks[i])
        core.violated_ticks[i] = ticks
        core.judged[i] = block.detector_values[i] = value
        block.detector_ticks[i] = ticks
        if ticks < detector.persistence_ticks:
            let_go(detector, core, i, value, block_address)
            continue
        keep_trip(detector, core, i, value, block_address)
        if detector.action > strongest:
            strongest, first = detector.action, i
    if strongest >= Action.STOP and block.first_out < 0:
        block.first_out = first
        block.first_out_tick = core.tick
    return strongest


@kernel
def keep_trip(detector: Record, core: Record, i: int, value: float, block_address: int) -> None:
    """Note a detector that calls for its action in this tick, and report it once."""
    bit = _ONE << np.uint64(i)
    core.violated |= bit
    if detector.action > Action.INDICATE:
        core.acting |= bit
    if core.trips & bit:
        return
    core.trips |= bit
    if detector.action > Action.INDICATE:
        core.blocking |= bit
    publish_event(block_address, core.tick, EventKind.TRIP, i, value, detector.threshold)


@kernel
def let_go(detector: Record, core: Record, i: int, value: float, block_address: int) -> None:
    """Forget a trip that does not latch, once its detector is content again."""
    bit = _ONE << np.uint64(i)
    if core.trips & bit and core.violated_ticks[i] == 0 and not latches(detector):
        core.trips &= ~bit
        core.blocking &= ~bit
        publish_event(block_address, core.tick, EventKind.CLEARED, i, value, detector.threshold)
