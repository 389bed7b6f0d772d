"""The table of detectors: what each watches, how it judges that, and what it does about it."""

import math
from enum import IntEnum

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.modes import Mode

MAX_DETECTORS = 64  # one bit of the trips each


class Quantity(IntEnum):
    """What a detector may watch. See `rtcore.quantities` for those that are derived."""

    FORCE_N = 0
    FORCE_ERROR_N = 1
    DISPLACEMENT_M = 2
    VELOCITY_M_S = 3
    SUPPLY_PRESSURE_PA = 4
    LOAD_CELL = 5  # a SensorFault, as those of the other sensors
    APP_SILENCE_S = 6  # time since the app's last heartbeat
    DEADLINES_MISSED = 7  # deadlines missed in one gap
    LVT = 8
    LVDT = 9
    PRESSURE_SENSOR = 10
    FORCE_ERROR_RELATIVE = 11  # error over the recent peak of the command
    UNDERPEAK = 12  # share by which the swing of the last cycle fell short of its command
    VALVE_COMMAND = 13
    VALVE_SATURATION = 14  # share of the last time that the valve was at its limit
    CYCLES = 15  # completed in this run
    TWIN_RESIDUAL_N = 16  # load cell minus that of the virtual rig beside it
    TWIN_GOODNESS = 17  # rolling G of the two, %
    UNRECORDED_S = 18  # samples that are not safe on a disk yet
    CHAIN_OPEN = 19  # the hard-wired chain, 0 closed, 1 open
    DISPLACEMENT_ERROR_M = 20
    PRESSURE_1_PA = 21
    PRESSURE_2_PA = 22
    TWIN_SPOOL = 23  # spool minus that of the virtual rig, share of its stroke


class SensorFault(IntEnum):
    """Why a sensor cannot be believed; the first that applies."""

    NONE = 0
    NOT_A_NUMBER = 1
    SATURATED = 2
    FROZEN = 3  # repeats itself to the last bit
    NOISE_FREE = 4  # smoother than its converter can be
    OUT_OF_RANGE = 5
    IMPLAUSIBLE = 6  # contradicts another sensor by the rig's physics


class Form(IntEnum):
    """Which value is made of a quantity before it is compared."""

    VALUE = 0
    RATE = 1  # its change in a second
    LOOK_AHEAD = 2  # what it will be after the horizon, at its present rate


class Comparison(IntEnum):
    """When a detector is violated; a NaN violates all of them."""

    MAGNITUDE_ABOVE = 0
    ABOVE = 1
    BELOW = 2
    OUTSIDE = 3  # of the band from `low` to `threshold`


class Action(IntEnum):
    """What a violated detector does; the strongest of several wins."""

    INDICATE = 0
    HOLD = 1
    STOP = 2  # take the load off in a controlled way, then latch
    SHUTDOWN = 3  # valve to null and supply off at once, latched


DETECTOR = np.dtype(
    [
        ("quantity", "i4"),
        ("form", "i4"),
        ("comparison", "i4"),
        ("action", "i4"),
        ("enabled", "i4"),
        ("latching", "i4"),  # STOP and SHUTDOWN latch whatever this says
        ("armed_modes", "i8"),  # one bit a mode
        ("persistence_ticks", "i8"),  # violated this long before it trips, at least 1
        ("threshold", "f8"),
        ("low", "f8"),  # of a band
        ("horizon_s", "f8"),  # of a look-ahead
        ("smoothing_s", "f8"),  # of a rate, 0 for none
    ],
    align=True,
)

INTERLOCKS = np.dtype([("count", "i8"), ("detectors", DETECTOR, (MAX_DETECTORS,))], align=True)

# What a detector remembers of the value before.
TREND = np.dtype([("last", "f8"), ("rate_1_s", "f8")], align=True)


def armed_in(*modes: Mode) -> int:
    """The bit mask of the modes in which a detector is armed."""
    return sum(1 << mode for mode in modes)


_QUANTITIES, _FORMS, _COMPARISONS, _ACTIONS = (
    len(members) for members in (Quantity, Form, Comparison, Action)
)
_HAS_LOW = np.zeros(len(Comparison), np.bool_)
_HAS_LOW[Comparison.OUTSIDE] = True
NO_ACTION = -1


@kernel
def judged_value(detector: Record, trend: Record, value: float, period_s: float) -> float:
    """The value that is compared, in the unit of the quantity (a second, for a rate).

    The rate starts anew after a value that is no number, so that a fault that has gone leaves nothing behind.
    """
    rate = (value - trend.last) / period_s
    trend.last = value
    if not math.isfinite(rate):
        rate = 0.0
    share = period_s / max(detector.smoothing_s, period_s)
    trend.rate_1_s += share * (rate - trend.rate_1_s)
    if not math.isfinite(value):
        return value
    if detector.form == Form.RATE:
        return trend.rate_1_s
    if detector.form == Form.LOOK_AHEAD:
        return value + detector.horizon_s * trend.rate_1_s
    return value


@kernel
def is_violated(detector: Record, value: float) -> bool:
    """Written so that a NaN, on either side, is a violation, and a comparison that nobody knows is one."""
    if detector.comparison == Comparison.ABOVE:
        return not (value <= detector.threshold)
    if detector.comparison == Comparison.BELOW:
        return not (value >= detector.threshold)
    if detector.comparison == Comparison.OUTSIDE:
        return not (detector.low <= value <= detector.threshold)
    if detector.comparison == Comparison.MAGNITUDE_ABOVE:
        return not (abs(value) <= detector.threshold)
    return True


@kernel
def check_detector(detector: Record, value: float, mode: int, violated_ticks: int) -> int:
    """Ticks for which a detector has been violated, this one included; 0 where it is content or not armed."""
    armed = detector.enabled and (detector.armed_modes >> mode) & 1
    if armed and is_violated(detector, value):
        return violated_ticks + 1
    return 0


@kernel
def latches(detector: Record) -> bool:
    """Whether a trip stays until a reset. What takes the load off always does."""
    return detector.action >= Action.STOP or bool(detector.latching)


@kernel
def interlocks_are_valid(table: Record) -> bool:
    """Whether the loop may adopt a table: within the bank, every detector meaningful."""
    if not 1 <= table.count <= MAX_DETECTORS:
        return False
    valid = True
    for i in range(table.count):
        valid = valid and detector_is_valid(table.detectors[i])
    return valid


@kernel
def detector_is_valid(d: Record) -> bool:
    """Whether every field of a detector means something."""
    known = 0 <= d.quantity < _QUANTITIES and 0 <= d.form < _FORMS
    if not (known and 0 <= d.comparison < _COMPARISONS and 0 <= d.action < _ACTIONS):
        return False
    if _HAS_LOW[d.comparison] and not (math.isfinite(d.low) and d.low < d.threshold):
        return False
    for seconds in (d.horizon_s, d.smoothing_s):
        if not (math.isfinite(seconds) and seconds >= 0.0):
            return False
    return d.persistence_ticks >= 1 and math.isfinite(d.threshold)
