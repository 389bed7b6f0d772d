"""Keeps the scene's process for as long as somebody looks; nothing that becomes of it touches the console."""

import asyncio
import logging
from collections.abc import Callable
from pathlib import Path

from app.link.backoff import Backoff
from app.scene.chain import Chain, Reading
from app.scene.process import SceneProcess, sweep
from app.scene.schemas import SceneState
from app.scene.telling import LiveTold, RigTold, ViewTold

_log = logging.getLogger(__name__)
FRAME_S = 1 / 30
IDLE_S = 120.0  # after the last one has looked, it ends


class Keeper:
    """A task of the event loop. `chain` and `reading` tell the rig in force, and the rig now."""

    def __init__(
        self, data_dir: Path, chain: Callable[[], Chain], reading: Callable[[], Reading]
    ) -> None:
        self._log_file = data_dir / "scene.log"
        self._folder = data_dir.resolve() / "scene"
        self._chain, self._reading = chain, reading
        self._backoff = Backoff()
        self._wanted = asyncio.Event()
        self._wanted_at_s = 0.0
        self._process: SceneProcess | None = None
        self._task: asyncio.Task[None] | None = None
        self.state = SceneState.IDLE
        self.trouble = ""
        self.life = 0
        self.viewers = 0

    def start(self) -> None:
        """Begin to keep it: nothing runs before it is wanted."""
        sweep(self._folder)
        self._task = asyncio.get_running_loop().create_task(self._keep())

    async def stop(self) -> None:
        """End it, and keep it no longer."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)

    @property
    def process(self) -> SceneProcess | None:
        """The one that can be asked now."""
        return self._process if self.state is SceneState.READY else None

    def want(self) -> None:
        """Somebody looks, or is about to."""
        self._wanted_at_s = asyncio.get_running_loop().time()
        self._wanted.set()

    async def until_ready(self, patience_s: float) -> SceneProcess | None:
        """The process, once it can be asked; None where it cannot for so long."""
        self.want()
        clock_s = asyncio.get_running_loop().time
        until_s = clock_s() + patience_s
        while self.process is None and clock_s() < until_s:  # noqa: ASYNC110  # several may wait, and give up
            await asyncio.sleep(0.05)
        return self.process

    def tell(self, told: ViewTold) -> None:
        """Tell the process what a view shows. Where there is none, the view tells it when it comes."""
        if self._process is not None:
            self._process.tell(told)

    async def _keep(self) -> None:
        clock_s = asyncio.get_running_loop().time
        while True:
            self.state = SceneState.IDLE
            await self._wanted.wait()
            began_s = clock_s()
            try:
                self.trouble = await self._live() or ""
            except OSError as error:
                self.trouble = f"It cannot be started: {error}"
            if self.trouble == "":
                continue
            self.state = SceneState.WAITING
            pause_s = self._backoff.died(clock_s() - began_s)
            _log.warning("the 3-D view: %s; again in %.2f s", self.trouble, pause_s)
            await asyncio.sleep(pause_s)

    async def _live(self) -> str | None:
        """One life: why it ended, None where nobody looks any more."""
        self.state = SceneState.STARTING
        async with SceneProcess(self._log_file, self._folder) as process:
            self.life += 1
            self._process = process
            told = self._chain()
            process.tell(RigTold(told))
            try:
                while (why := process.why_ended()) is None and self._is_wanted():
                    if process.ready:
                        self.state = SceneState.READY
                    if told != (now := self._chain()):
                        process.tell(RigTold(told := now))
                    if self.viewers > 0:
                        process.tell(LiveTold(self._reading()))
                    await asyncio.sleep(FRAME_S)
            finally:
                self._process = None
            return why

    def _is_wanted(self) -> bool:
        if self.viewers > 0:
            self.want()
        if asyncio.get_running_loop().time() - self._wanted_at_s < IDLE_S:
            return True
        self._wanted.clear()
        return False
