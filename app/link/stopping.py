"""Stop by the word of the block: no command, no lease, no room in a ring, and no app but this one thread."""

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.errors import Code, Refusal
from app.link.life import Life
from app.link.supervisor import BlockError, left_over
from rtcore.memory.stopping import ask_stop
from rtcore.modes import Mode

CONFIRMED_S = 0.1
_POLL_S = 0.001
_UNDER_LOAD = (Mode.RUNNING, Mode.HOLDING)
NO_LOOP = Refusal(
    Code.LOOP_LOST, "The loop process does not run and can stop nothing: look at the rig"
)
_SILENT = Refusal(
    Code.LOOP_SILENT,
    f"The loop process did not confirm the stop within {CONFIRMED_S} s: use the emergency stop. "
    "It stops as soon as it goes on",
)


@dataclass(frozen=True)
class Stopped:
    """The loop takes the load off, or there was none: its mode in this tick."""

    mode: Mode
    tick: int

    @staticmethod
    def of(record: Any) -> "Stopped":
        """As a telemetry record has it."""
        return Stopped(Mode(int(record["mode"])), int(record["tick"]))


def stop(life: Life | None, within_s: float = CONFIRMED_S) -> Stopped | Refusal:
    """Have the loop stop, and wait for its word. Without a test there is nothing to stop: that is done."""
    if life is None or life.ended:
        return NO_LOOP
    before = life.snapshot()
    seen_tick = 0 if before is None else int(before["tick"]) + 2  # the next may be half done
    ask_stop(life.block)
    deadline = time.monotonic() + within_s
    while True:
        record = life.snapshot()
        now = None if record is None else Stopped.of(record)
        if now is not None and now.tick >= seen_tick and now.mode not in _UNDER_LOAD:
            return now
        if time.monotonic() >= deadline:
            return _SILENT
        time.sleep(_POLL_S)


def stop_directly(block: Path, within_s: float = 1.0) -> Stopped | Refusal:
    """The same without the console, from any process of this machine."""
    try:
        return stop(left_over(block), within_s)
    except BlockError as error:
        return Refusal(Code.LOOP_LOST, f"{str(error)[:1].upper()}{str(error)[1:]}")
