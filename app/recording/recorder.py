"""The recorder: a thread of its own that follows the loop, whatever the rest of the app does."""

import logging
from dataclasses import dataclass
from pathlib import Path
from queue import SimpleQueue
from threading import Event, Thread

from app.link.life import Life
from app.recording.clerk import Clerk
from app.recording.run_file import RunFile
from app.recording.tape import Tape

_log = logging.getLogger(__name__)
DRAIN_S = 0.1
SYNC_S = 1.0
RETRY_S = 1.0
MOST_FAILURES = 5


@dataclass(frozen=True)
class RecorderState:
    """What the console shows of the recorder; of a run under way its number, its ticks, the last one."""

    recording: bool
    lost_ticks: int
    size_bytes: int
    trouble: str | None
    run_id: int = 0
    ticks: int = 0
    last_tick: int = -1


class Recorder:
    """Follows one life of the loop after the other, each to its end."""

    def __init__(self, runs_dir: Path, clerk: Clerk) -> None:
        self._runs_dir = runs_dir
        self._clerk = clerk
        self._lives: SimpleQueue[Life | None] = SimpleQueue()
        self._ended = Event()
        self._tape: Tape | None = None
        self._unsynced: str | None = None  # why the last sync of the present part failed
        self.following: Life | None = None  # the life whose runs are recorded now
        self._thread = Thread(target=self._run, name="recorder", daemon=True)
        self._syncer = Thread(target=self._sync, name="recorder-sync", daemon=True)

    def start(self) -> None:
        """Begin to follow."""
        self._thread.start()
        self._syncer.start()

    def follow(self, life: Life) -> None:
        """Follow this life once the one before it has ended. Returns at once."""
        self._lives.put(life)

    def stop(self) -> None:
        """Drain the ended life to its last record, then end the thread."""
        self._lives.put(None)
        self._thread.join()
        self._ended.set()
        self._syncer.join()

    def state(self) -> RecorderState:
        """What it is doing."""
        tape = self._tape
        file = tape.current if tape is not None else None
        trouble = (tape.trouble if tape is not None else None) or self._unsynced
        if file is None:
            return RecorderState(False, 0, 0, trouble)
        extent, size = file.extent, file.size_bytes
        of = (trouble, file.run_id, extent.ticks, extent.last_tick)
        return RecorderState(True, file.missing_ticks, size, *of)

    def stopped_because(self, run_id: int, reason: str) -> None:
        """The console is about to stop this run for a reason of its own; raises `OSError`."""
        tape = self._tape
        file = tape.current if tape is not None else None
        if file is not None and file.run_id == run_id:
            file.stopped_because(reason)

    def _run(self) -> None:
        while (life := self._lives.get()) is not None:
            failures = 0
            while not self._followed(life) and failures < MOST_FAILURES:
                # A new tape goes on where the files end. A life that goes on is never given up.
                failures += life.ended
                self._ended.wait(RETRY_S)

    def _followed(self, life: Life) -> bool:
        """Follow a life; False where that failed, for the database or the disk does not answer."""
        try:
            self._follow(life)
        except Exception:
            _log.exception("the recorder failed in the life %s of the loop", life.name)
            return False
        finally:
            self.following = self._tape = None
        return True

    def _follow(self, life: Life) -> None:
        tape = self._tape = Tape(life, self._runs_dir, self._clerk)
        tape.drain()
        tape.end_unseen()
        self.following = life
        while not life.ended:
            self._ended.wait(DRAIN_S)
            tape.drain()
        tape.drain()  # what was published between the last drain and the end
        tape.finish()

    def _sync(self) -> None:
        """Sync the present part once a second. It may take seconds, so the drain does not do it."""
        while not self._ended.wait(SYNC_S):
            tape = self._tape
            file = tape.current if tape is not None else None
            self._unsynced = None if file is None else self._trouble_of_sync(file)

    def _trouble_of_sync(self, file: RunFile) -> str | None:
        """Sync; why that failed, where it did: what the system took may never get to the disk."""
        try:
            file.sync()
        except ValueError:  # closed meanwhile
            return None
        except OSError as error:
            if self._unsynced is None:
                _log.error("run %d: could not sync: %s", file.run_id, error)
            return error.strerror or str(error)
        return None
