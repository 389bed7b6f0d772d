"""Numbers that cross the shared memory, declared once: commands, replies, events."""

from enum import IntEnum


class Opcode(IntEnum):
    """What the app may ask of the loop."""

    RESET = 1
    PRESSURISE = 2
    DEPRESSURISE = 3
    TARE = 4
    START = 5
    HOLD = 6
    RESUME = 7
    STOP = 8
    SHUTDOWN = 9
    ADOPT_GAINS = 10
    ADOPT_INTERLOCKS = 11
    ADOPT_PROGRAM = 12
    INJECT_FAULT = 13  # into the simulated rig: which, and how much; 0 takes it away
    CLEAR_FAULTS = 14
    TAKE_LEASE = 15  # from now on only commands of this epoch are obeyed
    SKIP = 16  # to a segment further on in the force course, which continues the present sine
    ADOPT_MODEL = 17  # of the rig, for the twin


class Reply(IntEnum):
    """What the loop answers to a command."""

    ACCEPTED = 0
    WRONG_MODE = 1
    STALE_LEASE = 2
    EXPIRED = 3
    REPLAYED = 4
    UNKNOWN = 5
    CAUSE_PRESENT = 6
    INVALID_BANK = 7
    NO_PROGRAM = 8
    BUSY = 9
    NOT_CONFIGURED = 10  # no gains or no interlocks have been adopted
    NOT_AN_EDGE = 11  # the reset is held down
    NOT_SIMULATED = 12  # nobody breaks a real rig


class EventKind(IntEnum):
    """What the loop reports."""

    MODE = 1
    TRIP = 2
    COMMAND = 3
    BLOCK = 4
    PROGRAM_ENDED = 5
    DEADLINES_MISSED = 6
    PROGRAM_FAULT = 7  # a streamed program that did not come in time, or leads beyond the limits
    CLEARED = 8  # a detector that does not latch is content again
    LEASE = 9  # the epoch of the lease that is obeyed from now on
    FAULT = 10  # injected into the simulated rig, with its amount
    STOP_ASKED = 11  # on the path that needs no command
    SKIPPED = 12  # to which segment, and how many ticks of the program were left out
