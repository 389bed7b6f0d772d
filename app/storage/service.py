"""The disk that runs are recorded on: whether there is room, and what to do where there is not."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from app.db import Database
from app.errors import Code, Refusal
from app.recording.recorder import RecorderState
from app.storage import repository
from app.storage.retention import Retainer
from app.storage.schemas import StorageOut, StorageState, StorageWord
from app.storage.space import (
    FILE_BYTES_PER_TICK,
    PART_BYTES_PER_TICK,
    Space,
    bytes_of,
    bytes_of_runs,
    file_bytes_per_tick,
    space_of,
)

_LOW_S = 3600.0
_LONG_TICKS = 40_000  # a run that tells how many bytes a tick takes


@dataclass(frozen=True)
class StorageSettings:
    """Where runs are kept, how often there is a tick, and what is left to everything else."""

    runs_dir: Path
    period_s: float
    reserve_bytes: int


class Storage:
    """Watches the room for runs. May be asked from any thread."""

    def __init__(
        self,
        settings: StorageSettings,
        database: Database,
        recorder: Callable[[], RecorderState],
        space: Callable[[Path], Space] = space_of,
    ) -> None:
        self._settings = settings
        self._database = database
        self._recorder = recorder
        self._space = space
        self._file_bytes_per_tick = FILE_BYTES_PER_TICK  # until one has been measured
        self.retention = Retainer(database, settings.runs_dir)

    def state(self) -> StorageState:
        """What is always on the screen."""
        return self.judged(self._space(self._settings.runs_dir), self._recorder())

    def judged(self, space: Space, recorder: RecorderState) -> StorageState:
        """Free space against what the run under way needs to be filed, and what comes on top."""
        left = space.free_bytes - self.reserve_bytes(recorder)
        seconds_left = max(0.0, left / self.bytes_per_s())
        word = StorageWord.LOW if seconds_left < _LOW_S else StorageWord.OK
        return StorageState(
            free_bytes=space.free_bytes,
            state=StorageWord.FULL if left <= 0 else word,
            seconds_left=round(seconds_left, 1),
        )

    def reserve_bytes(self, recorder: RecorderState) -> int:
        """What must stay free: for the file of the run under way, and for the database."""
        return self._settings.reserve_bytes + round(recorder.ticks * self._file_bytes_per_tick)

    def reserved_bytes(self) -> int:
        """What must stay free now, with the run under way."""
        return self.reserve_bytes(self._recorder())

    def bytes_per_s(self) -> float:
        """What recording takes: a part goes on while the room for its file is kept free."""
        per_tick = PART_BYTES_PER_TICK + self._file_bytes_per_tick
        return per_tick / self._settings.period_s

    def measure(self) -> None:
        """Look at the latest long run again: what it takes is what the next one will."""
        with self._database.reading() as session:
            run = repository.last_long_run(session, _LONG_TICKS)
            found = None if run is None else (run.id, run.ticks)
        if found is not None:
            found = (bytes_of(self._settings.runs_dir / str(found[0])), found[1])
        self._file_bytes_per_tick = file_bytes_per_tick(found if found and found[0] else None)

    def refusal_for(self, duration_s: float | None) -> Refusal | None:
        """Why a run of this duration cannot be started; None where there is room. No duration: now."""
        free = self._space(self._settings.runs_dir).free_bytes
        needed = (duration_s or 0.0) * self.bytes_per_s() + self._settings.reserve_bytes
        if free > needed:
            return None
        room_s = max(0.0, (free - self._settings.reserve_bytes) / self.bytes_per_s())
        detail = (
            f"Cannot start: the run needs {_gb(needed)} on the disk and {_gb(free)} are free, "
            f"enough for {_time(room_s)}; remove samples of old runs, or shorten the test"
        )
        return Refusal(
            Code.NO_SPACE, detail, about={"free_bytes": free, "needed_bytes": int(needed)}
        )

    def overview(self) -> StorageOut:
        """The disk, what runs use of it, and how long samples are kept."""
        space, recorder = self._space(self._settings.runs_dir), self._recorder()
        state = self.judged(space, recorder)
        return StorageOut(
            free_bytes=space.free_bytes,
            total_bytes=space.total_bytes,
            used_by_runs_bytes=sum(bytes_of_runs(self._settings.runs_dir).values()),
            bytes_per_s=self.bytes_per_s(),
            reserve_bytes=self.reserve_bytes(recorder),
            state=state.state,
            seconds_left=state.seconds_left,
            retention=self.retention.rule(),
        )


def _time(seconds: float) -> str:
    for unit, name in ((86_400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * unit:
            return f"{seconds / unit:,.0f} {name}"
    return f"{seconds:,.0f} s"


def _gb(number: float) -> str:
    return f"{number / 1e9:,.1f} GB" if number >= 1e9 else f"{number / 1e6:,.0f} MB"
