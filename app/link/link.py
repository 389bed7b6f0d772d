"""The link as the rest of the app sees it: the present life of the loop, and what can be asked."""

import logging
import time
from collections.abc import Callable
from typing import Any

from app.errors import Code, Refusal
from app.link.banks import adopt, load
from app.link.commander import Answer, Commander
from app.link.feeder import Feeder
from app.link.heartbeat import Heartbeat
from app.link.life import Life
from app.link.process import LoopCommand, end_loop
from app.link.refusals import as_refusal
from app.link.supervisor import Supervisor
from rtcore.codes import Opcode, Reply
from rtcore.memory.segment import BlockError, lock_single_loop
from rtcore.modes import is_run
from rtcore.program.stream import Program

_log = logging.getLogger(__name__)
_LOAD_OFF_S = 15.0
_CONFIGURED_S = 1.0


class Link:
    """Supervisor, heartbeat and commands of one loop."""

    def __init__(
        self,
        command: LoopCommand,
        on_life: Callable[[Life], None],
        configure: Callable[["Link"], bool],
    ) -> None:
        self._heard = on_life
        self._heartbeat = Heartbeat()
        self._supervisor = Supervisor(command, self._on_life, lambda life: configure(self))
        self._feeder: Feeder | None = None
        self.commander = Commander()

    @property
    def life(self) -> Life | None:
        """The latest life of the loop, dead or alive."""
        return self._supervisor.life

    @property
    def starting(self) -> bool:
        """Whether a loop process is being started."""
        return self._supervisor.starting

    def start(self) -> None:
        """Attach or start. Raises `BlockError` where a loop of another version runs."""
        self._heartbeat.start()
        self._supervisor.start()

    def _on_life(self, life: Life) -> None:
        if not life.ended:
            self._heartbeat.turn_to(life)
            self.commander.turn_to(life)
        self._heard(life)

    def ask(
        self, opcode: Opcode, argument: int = 0, *, value: float = 0.0, lease: int | None = None
    ) -> Answer | Refusal:
        """Give a command. The answer is the loop's acceptance; all else is a refusal.

        What a client asks for bears the `lease` of that client; without one it is the console that
        keeps house. A loop that has only just begun may still be waiting for its gains and interlocks: so does this.
        """
        answer = self.commander.ask(opcode, argument, value=value, lease=lease)
        deadline = time.monotonic() + _CONFIGURED_S
        while _is_not_configured(answer) and time.monotonic() < deadline:
            time.sleep(0.02)
            answer = self.commander.ask(opcode, argument, value=value, lease=lease)
        return as_refusal(opcode, answer) or answer

    def adopt(self, opcode: Opcode, record: Any, lease: int | None = None) -> Refusal | None:
        """Have the loop take over a bank, whole or not at all; None where it did. `lease` as of `ask`."""
        life = self.life
        if life is None:
            return Refusal(Code.LOOP_LOST, "The loop process does not run")
        return adopt(life, self.commander, opcode, record, lease)

    def load_program(self, program: Program, lease: int | None = None) -> Refusal | None:
        """Have the loop take over a program, and go on giving what is longer than its bank.

        `lease` as of `ask`. None where it did; then nothing of the program before it is given any more.
        """
        life = self.life
        if life is None:
            return Refusal(Code.LOOP_LOST, "The loop process does not run")
        feeder = load(life, self.commander, program, lease)
        if isinstance(feeder, Refusal):
            return feeder
        self._stop_feeding()
        self._feeder = feeder
        feeder.start()
        return None

    def _stop_feeding(self) -> None:
        if self._feeder is not None:
            self._feeder.stop()
            self._feeder = None

    def take_load_off(self) -> None:
        """Stop, wait until the load is off, depressurise: what a clean end of the console does."""
        life = self.life
        if life is None or not life.alive:
            return
        self.ask(Opcode.STOP)
        deadline = time.monotonic() + _LOAD_OFF_S
        while _is_loaded(life) and time.monotonic() < deadline:
            time.sleep(0.02)
        self.ask(Opcode.DEPRESSURISE)

    def end_loop(self) -> None:
        """End the loop process, so that none is left without a console."""
        self._stop_feeding()
        self._supervisor.stop()
        life = self.life
        if life is not None and not life.ended:
            end_loop(self._supervisor.block, life.pid)
            life.ended = True
        self._supervisor.reap()

    def forget(self) -> None:
        """Fall silent, and remove the block: all that was in it has been recorded."""
        self._heartbeat.stop()
        block = self._supervisor.block
        try:
            with lock_single_loop(block):  # only where no loop has it
                for path in (block, block.with_suffix(".lock")):
                    path.unlink(missing_ok=True)
        except BlockError as error:
            _log.error("the loop process did not end: %s", error)


def _is_not_configured(answer: Answer | Refusal) -> bool:
    return isinstance(answer, Answer) and answer.reply is Reply.NOT_CONFIGURED


def _is_loaded(life: Life) -> bool:
    mode = life.mode()
    return life.alive and mode is not None and is_run(mode)
