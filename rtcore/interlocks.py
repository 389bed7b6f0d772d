"""The table of detectors, evaluated every tick; the first to trip is kept."""

import math
from enum import IntEnum

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.modes import Mode

MAX_DETECTORS = 32


class Quantity(IntEnum):
    """What a detector may watch."""

    FORCE_N = 0
    FORCE_ERROR_N = 1
    DISPLACEMENT_M = 2
    VELOCITY_M_S = 3
    SUPPLY_PRESSURE_PA = 4
    SENSOR_FAULTS = 5  # sensors that are not finite, saturated or frozen
    APP_SILENCE_S = 6  # time since the app's last heartbeat
    DEADLINES_MISSED = 7  # deadlines missed in one gap


class Comparison(IntEnum):
    """When a detector is violated; a NaN violates all three."""

    MAGNITUDE_ABOVE = 0
    ABOVE = 1
    BELOW = 2


class Action(IntEnum):
    """What a violated detector does; the strongest of several wins."""

    INDICATE = 0
    HOLD = 1
    STOP = 2  # take the load off in a controlled way, then latch
    SHUTDOWN = 3  # valve to null and supply off at once, latched


DETECTOR = np.dtype(
    [
        ("quantity", "i4"),
        ("comparison", "i4"),
        ("action", "i4"),
        ("enabled", "i4"),
        ("armed_modes", "i8"),  # one bit a mode
        ("persistence_ticks", "i8"),  # violated this long before it trips, at least 1
        ("threshold", "f8"),
    ],
    align=True,
)

INTERLOCKS = np.dtype([("count", "i8"), ("detectors", DETECTOR, (MAX_DETECTORS,))], align=True)


def armed_in(*modes: Mode) -> int:
    """The bit mask of the modes in which a detector is armed."""
    return sum(1 << mode for mode in modes)


_QUANTITIES, _COMPARISONS, _ACTIONS = len(Quantity), len(Comparison), len(Action)
NO_ACTION = -1


@kernel
def is_violated(detector: Record, value: float) -> bool:
    """Written so that a NaN, on either side, is a violation."""
    if detector.comparison == Comparison.ABOVE:
        return not (value <= detector.threshold)
    if detector.comparison == Comparison.BELOW:
        return not (value >= detector.threshold)
    return not (abs(value) <= detector.threshold)


@kernel
def check_detector(detector: Record, value: float, mode: int, violated_ticks: int) -> int:
    """Ticks for which a detector has been violated, this one included; 0 where it is content or not armed."""
    armed = detector.enabled != 0 and (detector.armed_modes >> mode) & 1 == 1
    if armed and is_violated(detector, value):
        return violated_ticks + 1
    return 0


@kernel
def interlocks_are_valid(table: Record) -> bool:
    """Whether the loop may adopt a table: within the bank, every detector meaningful."""
    if table.count < 1 or table.count > MAX_DETECTORS:
        return False
    for i in range(table.count):
        d = table.detectors[i]
        known = 0 <= d.quantity < _QUANTITIES and 0 <= d.comparison < _COMPARISONS
        if not known or not 0 <= d.action < _ACTIONS:
            return False
        if d.persistence_ticks < 1 or not math.isfinite(d.threshold):
            return False
    return True
