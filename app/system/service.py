"""What can be asked about the system."""

import os
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from time import monotonic

from app.db import Database
from app.errors import Code, Refusal
from app.link.life import Life
from app.settings import VERSION
from app.system.diagnosis import diagnose
from app.system.processes import folder_bytes, memory_bytes
from app.system.schemas import About, Diagnosis, LoopTiming
from app.system.timing import timing

_NO_LOOP = Refusal(
    Code.LOOP_LOST, "No loop runs yet: there is nothing to show of how it keeps time"
)


class System:
    """Looks and changes nothing. It counts the console's life from when it was made."""

    def __init__(
        self,
        database: Database,
        data_dir: Path,
        life: Callable[[], Life | None],
        clients: Callable[[], int],
    ) -> None:
        self._database = database
        self._data_dir = data_dir
        self._life = life
        self._clients = clients
        self._started_at = datetime.now(UTC)
        self._started_s = monotonic()

    def loop(self) -> LoopTiming | Refusal:
        """How the loop keeps time."""
        life = self._life()
        return _NO_LOOP if life is None else timing(life)

    def doctor(self) -> Diagnosis:
        """Whether the machine is fit for real time."""
        return diagnose(self._life())

    def about(self) -> About:
        """Version, database, data, clients and memory."""
        life = self._life()
        return About(
            version=VERSION,
            database=self._database.engine.dialect.name,
            started_at=self._started_at,
            uptime_s=monotonic() - self._started_s,
            data_bytes=folder_bytes(self._data_dir),
            clients=self._clients(),
            console_memory_bytes=memory_bytes(os.getpid()),
            loop_memory_bytes=None if life is None else memory_bytes(life.pid),
        )
