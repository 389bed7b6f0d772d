"""Keeps one loop alive: attaches to a running one, or starts one, and again when it dies.

A new loop comes up tripped; nothing here ever resets or pressurises it.
"""

import logging
import subprocess
from collections.abc import Callable
from pathlib import Path
from threading import Event, Thread
from time import monotonic

from app.link.backoff import Backoff
from app.link.life import Life
from app.link.process import LoopCommand
from rtcore.memory.segment import BlockError, attach_block, loop_is_running
from rtcore.modes import Mode

__all__ = ["BlockError", "Supervisor", "left_over"]

_log = logging.getLogger(__name__)
_WATCH_S = 0.05
_TELL_S = 5.0
START_LIMIT_S = 180.0  # the first start compiles every kernel


class Supervisor:
    """The thread that watches the loop.

    `on_life` is told of every life, a left-over one included. `configure` gives a loop its gains
    and interlocks as soon as that is safe, and says whether it did.
    """

    def __init__(
        self,
        command: LoopCommand,
        on_life: Callable[[Life], None],
        configure: Callable[[Life], bool],
    ) -> None:
        self._command = command
        self._on_life = on_life
        self._configure = configure
        self._backoff = Backoff()
        self._ended = Event()
        self._thread = Thread(target=self._run, name="supervisor", daemon=True)
        self._child: subprocess.Popen[bytes] | None = None
        self.life: Life | None = None
        self.starting = True  # until the first loop beats, or has failed to

    @property
    def block(self) -> Path:
        return self._command.block

    def start(self) -> None:
        """Attach to what is there, then watch.

        Raises `BlockError` where a loop of another version runs.
        """
        life = left_over(self.block)
        if life is not None:
            _log.info("found the %s of an earlier start", "loop" if life.alive else "last samples")
            self._adopt(life)
        self._thread.start()

    def stop(self) -> None:
        """Watch no longer. A running loop is left as it is, one that is still starting is ended."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def _adopt(self, life: Life) -> None:
        self.life = life
        self.starting = self.starting and life.ended
        self._on_life(life)

    def _run(self) -> None:
        while not self._ended.is_set():
            life = self.life
            if life is not None and life.alive:
                if not life.configured and _may_be_configured(life):
                    life.configured = self._configure(life)
            elif loop_is_running(self.block):
                self._look_for_another(life)
            elif life is None or life.ended:
                self._start_loop()
            else:
                self._bury(life)
            self._ended.wait(_WATCH_S)

    def _look_for_another(self, life: Life | None) -> None:
        """A loop that was still starting when its console was killed lays its own block in the old one's place."""
        try:
            found = Life(attach_block(self.block))
        except BlockError:
            return
        if found.beaten and (life is None or found.name != life.name):
            _log.info("the loop process %d, begun by an earlier start, runs", found.pid)
            if life is not None:
                life.ended = True  # nobody writes its block any more
            self._adopt(found)

    def _bury(self, life: Life) -> None:
        """Nobody holds the lock any more: what is in the block is all there will be."""
        life.ended = True
        self.reap()
        started_s = int(life.block.fields["loop_started_ns"]) * 1e-9
        pause_s = self._backoff.died(max(0.0, monotonic() - started_s))
        _log.error("the loop process %d has ended; a new one starts in %.2f s", life.pid, pause_s)
        self._ended.wait(pause_s)

    def reap(self) -> None:
        """Collect the exit of a loop that this app started, and that is ending."""
        if self._child is not None and self._child.poll() is None:
            try:
                self._child.wait(timeout=5.0)
            except subprocess.TimeoutExpired:
                self._child.kill()
                self._child.wait()
        self._child = None

    def _start_loop(self) -> None:
        _log.info(
            "starting the loop process (the first start compiles its kernels: up to a minute)"
        )
        self._child = self._command.start()
        life = self._await_life(self._child)
        if life is not None:
            _log.info("the loop process %d runs", life.pid)
            self._adopt(life)

    def _await_life(self, child: subprocess.Popen[bytes]) -> Life | None:
        began = told = monotonic()
        while not self._ended.wait(0.02):
            life = _life_of(self.block, child.pid)
            if life is not None:
                return life
            now = monotonic()
            if child.poll() is not None or now - began > START_LIMIT_S:
                self._give_up(child, now - began)
                return None
            if now - told > _TELL_S:
                told = now
                _log.info("the loop process is getting ready (%.0f s)", now - began)
        child.terminate()
        return None

    def _give_up(self, child: subprocess.Popen[bytes], lived_s: float) -> None:
        if child.poll() is None:
            child.kill()
        child.wait()
        self.starting = False
        pause_s = self._backoff.died(0.0)
        words = self._command.last_words()
        _log.error("the loop process did not start (%.0f s): %s", lived_s, words)
        self._ended.wait(pause_s)


def _life_of(path: Path, pid: int) -> Life | None:
    """The life of the loop with this process id, once it beats."""
    try:
        life = Life(attach_block(path))
    except BlockError:
        return None
    return life if life.pid == pid and life.beaten else None


def _may_be_configured(life: Life) -> bool:
    """Whether gains and interlocks may be changed now: the supply is off."""
    return life.alive and life.mode() in (Mode.TRIPPED, Mode.OFF)


def left_over(path: Path) -> Life | None:
    """What an earlier start of the app left behind: a running loop, or the block of a dead one.

    None where there is nothing, or a loop that has no block yet. Raises `BlockError` where a loop of
    another version runs.
    """
    running = loop_is_running(path)
    try:
        return Life(attach_block(path), ended=not running)
    except BlockError as error:
        if running and path.exists():
            raise
        if path.exists():
            _log.warning("%s. No loop runs on it: it is replaced", error)
        return None
