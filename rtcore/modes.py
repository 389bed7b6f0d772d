"""The states of the loop, as one table and a pure function over it."""

from enum import IntEnum

import numpy as np

from rtcore.compiled import kernel


class Mode(IntEnum):
    """What the rig is doing. `TRIPPED` is how the loop starts."""

    TRIPPED = 0
    OFF = 1
    PRESSURISING = 2
    READY = 3
    RUNNING = 4
    HOLDING = 5
    STOPPING = 6


class Event(IntEnum):
    """What moves the loop from one mode to another."""

    RESET = 0  # by command, with no cause present
    PRESSURISE = 1  # by command
    PRESSURE_REACHED = 2
    START = 3  # by command
    HOLD = 4  # by command or detector
    RESUME = 5  # by command
    STOP = 6  # by command, detector, or the end of the program
    STOPPED = 7  # the load has been taken off
    DEPRESSURISE = 8  # by command
    TRIP = 9  # by detector or command: at once


TRANSITIONS = {
    (Mode.TRIPPED, Event.RESET): Mode.OFF,
    (Mode.OFF, Event.PRESSURISE): Mode.PRESSURISING,
    (Mode.PRESSURISING, Event.PRESSURE_REACHED): Mode.READY,
    (Mode.PRESSURISING, Event.DEPRESSURISE): Mode.OFF,
    (Mode.PRESSURISING, Event.STOP): Mode.OFF,
    (Mode.READY, Event.START): Mode.RUNNING,
    (Mode.READY, Event.DEPRESSURISE): Mode.OFF,
    (Mode.RUNNING, Event.HOLD): Mode.HOLDING,
    (Mode.RUNNING, Event.STOP): Mode.STOPPING,
    (Mode.HOLDING, Event.RESUME): Mode.RUNNING,
    (Mode.HOLDING, Event.STOP): Mode.STOPPING,
    (Mode.STOPPING, Event.STOP): Mode.STOPPING,
    (Mode.STOPPING, Event.STOPPED): Mode.READY,
    **{(mode, Event.TRIP): Mode.TRIPPED for mode in Mode},
}

NO_TRANSITION = -1
_TABLE = np.full((len(Mode), len(Event)), NO_TRANSITION, dtype=np.int64)
for (_mode, _event), _next in TRANSITIONS.items():
    _TABLE[_mode, _event] = _next


@kernel
def next_mode(mode: int, event: int) -> int:
    """The mode after an event, or `NO_TRANSITION` where the event means nothing in this mode."""
    return int(_TABLE[mode, event])


@kernel
def is_pressurised(mode: int) -> bool:
    """Whether supply pressure is commanded on in this mode."""
    return mode >= Mode.PRESSURISING


@kernel
def is_closed_loop(mode: int) -> bool:
    """Whether the force loop is closed; elsewhere the valve is at null."""
    return mode >= Mode.READY


@kernel
def is_run(mode: int) -> bool:
    """Whether a test is under way, its end included."""
    return mode >= Mode.RUNNING
