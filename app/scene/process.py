"""One life of the scene's process, as the console sees it."""

import asyncio
import os
import shutil
import sys
from asyncio.subprocess import PIPE, Process
from pathlib import Path
from types import TracebackType
from typing import Self

from app.scene.telling import LiveTold, Told, line

START_LIMIT_S = 60.0
SILENT_S = 10.0  # at a low priority, on a busy machine
MOST_UNREAD_BYTES = 65_536  # of what is told: then the rig now is left out, as it is old at once
END_LIMIT_S = 2.0


SOCKET = "socket"


def sweep(folder: Path) -> None:
    """Remove what a process has left, and who kept it could not: they were killed."""
    shutil.rmtree(folder, ignore_errors=True)


class SceneProcess:
    """Started on entering, ended on leaving. What it says goes to a log, its socket to a folder of its own."""

    def __init__(self, log: Path, folder: Path) -> None:
        """`folder` is of one such process at a time: what an earlier one has left there goes."""
        self._log = log
        self._folder = folder
        sweep(folder)
        folder.mkdir(mode=0o700)  # for this user alone
        self._opened = -1
        self._process: Process | None = None
        self._hearing: asyncio.Task[None] | None = None
        self._heard_s = self._clock_s()
        self.ready = False

    async def __aenter__(self) -> Self:
        with self._log.open("wb") as log:
            self._process = await asyncio.create_subprocess_exec(
                *(sys.executable, "-m", "app.scene", str(self._folder / SOCKET)),
                stdin=PIPE,
                stdout=PIPE,
                stderr=log,
                start_new_session=True,
            )
        self._opened = os.open(self._folder, os.O_PATH | os.O_DIRECTORY)
        self._hearing = asyncio.create_task(self._hear())
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        process, hearing = self._running, self._hearing
        if process.returncode is None:
            process.kill()
        await asyncio.wait_for(process.wait(), END_LIMIT_S)
        if hearing is not None:
            hearing.cancel()
            await asyncio.gather(hearing, return_exceptions=True)
        os.close(self._opened)
        sweep(self._folder)

    @property
    def socket(self) -> str:
        """Where it listens: however deep the folder lies, the name of a socket is short."""
        return f"/proc/self/fd/{self._opened}/{SOCKET}"

    @property
    def pid(self) -> int:
        """Its process id."""
        return self._running.pid

    def tell(self, told: Told) -> None:
        """Tell it something; not the rig now where it has still to read what it was told before."""
        stdin = self._running.stdin
        if stdin is None or stdin.is_closing():
            return
        unread = stdin.transport.get_write_buffer_size()
        if not (isinstance(told, LiveTold) and unread > MOST_UNREAD_BYTES):
            stdin.write(line(told))

    def why_ended(self) -> str | None:
        """What has become of it, None while it lives."""
        code = self._running.returncode
        if code is not None:
            words = self._last_words()
            return f"It was ended by signal {-code}" if code < 0 else f"It has ended: {words}"
        limit_s = SILENT_S if self.ready else START_LIMIT_S
        if self._clock_s() - self._heard_s > limit_s:
            return f"It has said nothing for {limit_s:.0f} s"
        return None

    async def _hear(self) -> None:
        """Each line is a sign of life, the first one that it can be asked."""
        assert self._running.stdout is not None
        async for _ in self._running.stdout:
            self.ready = True
            self._heard_s = self._clock_s()

    def _last_words(self) -> str:
        lines = self._log.read_text(errors="replace").strip().splitlines()[-1:]
        return lines[0] if lines else "it said nothing"

    @property
    def _running(self) -> Process:
        assert self._process is not None
        return self._process

    @staticmethod
    def _clock_s() -> float:
        return asyncio.get_running_loop().time()
