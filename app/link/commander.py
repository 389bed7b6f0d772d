"""Commands to the loop: posted from one locked place, answered within half a second or not."""

import time
from dataclasses import dataclass
from threading import Lock

from app.errors import Code, Refusal
from app.link.life import Life
from rtcore.codes import Opcode, Reply
from rtcore.memory import commands

TIME_TO_LIVE_S = 0.5
_POLL_S = 0.001
_LOST = Refusal(
    Code.LOOP_LOST, "The loop process does not run: wait until it is back, then press Reset"
)
_SILENT = Refusal(
    Code.LOOP_SILENT, f"The loop process did not answer within {TIME_TO_LIVE_S} s: look at the rig"
)


@dataclass(frozen=True)
class Answer:
    """What the loop said to a command, and at which tick."""

    reply: Reply
    tick: int


class Commander:
    """Posts commands into the block of the present life of the loop."""

    def __init__(self) -> None:
        self._life: Life | None = None
        self._posting = Lock()  # the ring of commands has one writer

    def turn_to(self, life: Life | None) -> None:
        """Talk to this life of the loop from now on."""
        with self._posting:
            self._life = life

    def ask(
        self, opcode: Opcode, argument: int = 0, *, value: float = 0.0, lease: int | None = None
    ) -> Answer | Refusal:
        """Post a command and wait for the loop's reply. The lock is not held during the wait:
        a Stop never waits for another command's answer.

        Without a lease it bears the epoch in force: so the console keeps house, never a client.
        """
        with self._posting:
            life = self._life
            if life is None or not life.alive:
                return _LOST
            try:
                sequence = commands.post(
                    life.block,
                    opcode,
                    argument,
                    value=value,
                    lease=life.lease if lease is None else lease,
                    time_to_live_s=TIME_TO_LIVE_S,
                )
            except commands.CommandsFull:
                return _SILENT
        return _wait(life, sequence)


def _wait(life: Life, sequence: int) -> Answer | Refusal:
    # The loop refuses a command that is past its time to live, and that answer is waited for too.
    deadline = time.monotonic() + TIME_TO_LIVE_S + 0.1
    while time.monotonic() < deadline:
        answer = commands.acknowledgement(life.block, sequence)
        if answer is not None:
            return Answer(Reply(answer[0]), answer[1])
        time.sleep(_POLL_S)
    return _SILENT
