"""Everything that the metrics tell, looked at once for each of them."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from app.db import Database
from app.link.life import Life
from app.recording.recorder import RecorderState
from app.rigs.schemas import RigStatus
from app.runs import repository
from app.system.processes import memory_bytes
from app.system.timing import figures
from rtcore.latency import LoopFigures


@dataclass(frozen=True)
class Facts:
    """As they are at one moment; None for what is of a loop that is not there."""

    status: RigStatus
    loop: LoopFigures | None
    recorder: RecorderState
    recorder_behind_ticks: int | None
    clients: int
    runs: Mapping[str, int]  # by outcome
    memory_bytes: Mapping[str, int]  # by process


@dataclass(frozen=True)
class Sources:
    """Where they come from. None of them is waited for by the loop."""

    status: Callable[[], RigStatus]
    life: Callable[[], Life | None]
    recorder: Callable[[], RecorderState]
    clients: Callable[[], int]
    database: Database

    def facts(self) -> Facts:
        """Look at all of them."""
        life, recorder, status = self.life(), self.recorder(), self.status()
        behind = status.loop.tick - recorder.last_tick if recorder.recording else None
        with self.database.reading() as session:
            runs = repository.by_outcome(session)
        pids = {"console": os.getpid()} | ({} if life is None else {"loop": life.pid})
        memory = {name: memory_bytes(pid) for name, pid in pids.items()}
        return Facts(
            status=status,
            loop=None if life is None else figures(life),
            recorder=recorder,
            recorder_behind_ticks=None if behind is None else max(0, behind),
            clients=self.clients(),
            runs=runs,
            memory_bytes={name: held for name, held in memory.items() if held is not None},
        )
