"""How a run ended, read off what the loop reported of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from app.link.events import LoopEvent
from rtcore.codes import Opcode
from rtcore.modes import Mode


class Outcome(StrEnum):
    """How a run ended."""

    COMPLETED = "completed"  # the test ran to its end
    STOPPED = "stopped"  # by the operator
    TRIPPED = "tripped"  # by a detector
    FAILED = "failed"  # never began
    INTERRUPTED = "interrupted"  # the loop process ended, or its end is not known


@dataclass(frozen=True)
class Ending:
    """The outcome of a run and why, in a sentence; no reason where it ran to its end."""

    outcome: Outcome
    reason: str | None


LOOP_ENDED = Ending(Outcome.INTERRUPTED, "The loop process ended during the run")
UNKNOWN = Ending(Outcome.INTERRUPTED, "How the run ended is not known: its end was not recorded")
NEVER_BEGAN = Ending(Outcome.FAILED, "The loop never began this run")


def ending_of(events: Sequence[LoopEvent]) -> Ending:
    """The ending of a run from its events, the one in which the loop left it included."""
    tripped = any(e.is_mode(Mode.TRIPPED) for e in events)
    trips = [e for e in events if e.ends_run]
    if tripped and trips:
        return Ending(Outcome.TRIPPED, trips[0].text)
    if any(e.is_accepted(Opcode.SHUTDOWN) for e in events):
        return Ending(Outcome.STOPPED, "Shut down by the operator")
    if tripped:
        return Ending(Outcome.TRIPPED, "Tripped; which detector did it is not known")
    if any(e.kind == "program_ended" for e in events):
        return Ending(Outcome.COMPLETED, None)
    if any(e.is_accepted(Opcode.STOP) for e in events):
        return Ending(Outcome.STOPPED, "Stopped by the operator")
    return UNKNOWN


def last_tick_by_events(events: Sequence[LoopEvent], left_at: int, tail_ticks: int) -> int:
    """The last tick of a run whose end was lost from the ring, to within a tick.

    A run ends in the tick before the loop goes to `ready` or `off`, or `tail_ticks` after a trip;
    `left_at` is a tick that certainly is after its end.
    """
    last = left_at - 1
    for event in events:
        if event.is_mode(Mode.TRIPPED):
            last = min(last, event.tick + tail_ticks)
        elif event.is_mode(Mode.READY) or event.is_mode(Mode.OFF):
            return min(last, event.tick - 1)
    return last
