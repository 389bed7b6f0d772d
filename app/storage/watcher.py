"""The watcher: stops a run in good time before the disk is full, and keeps to the rule of retention."""

import logging
from collections.abc import Callable
from datetime import timedelta
from threading import Event, Thread

from app.errors import Refusal
from app.recording.recorder import RecorderState
from app.storage.schemas import StorageWord
from app.storage.service import Storage

_log = logging.getLogger(__name__)
LOOK_S = 1.0
_HOUR_LOOKS = round(timedelta(hours=1).total_seconds() / LOOK_S)
REASON = "Stopped: the disk was full ({free:,.0f} MB left); all that was recorded is kept"


class Watcher:
    """Looks once a second, in a thread of its own.

    `stop` takes the load off; `because` keeps the reason beside the run's samples.
    """

    def __init__(
        self,
        storage: Storage,
        recorder: Callable[[], RecorderState],
        because: Callable[[int, str], None],
        stop: Callable[[], Refusal | object],
    ) -> None:
        self._storage = storage
        self._recorder = recorder
        self._because = because
        self._stop = stop
        self._stopped_run = 0
        self._last_run = -1
        self._ended = Event()
        self._thread = Thread(target=self._watch, name="storage", daemon=True)

    def start(self) -> None:
        """Begin to watch."""
        self._thread.start()

    def close(self) -> None:
        """End the thread."""
        self._ended.set()
        self._thread.join()

    def look(self) -> None:
        """Look once: a run without room is stopped, once."""
        recorder = self._recorder()
        if recorder.run_id != self._last_run:
            self._last_run = recorder.run_id
            self._storage.measure()
        state = self._storage.state()
        if state.state is not StorageWord.FULL or not recorder.recording:
            return
        if recorder.run_id != self._stopped_run:
            self._stop_run(recorder.run_id, state.free_bytes)

    def _stop_run(self, run_id: int, free_bytes: int) -> None:
        reason = REASON.format(free=free_bytes / 1e6)
        try:
            self._because(run_id, reason)
        except OSError as error:  # it is stopped all the same
            _log.warning("run %d: could not keep why it is stopped: %s", run_id, error)
        _log.error("run %d: %s", run_id, reason)
        answer = self._stop()
        if isinstance(answer, Refusal):
            _log.warning("run %d: could not be stopped yet: %s", run_id, answer.detail)
        else:
            self._stopped_run = run_id

    def _watch(self) -> None:
        looks = 0
        while not self._ended.wait(LOOK_S):
            try:
                self.look()
                if looks % _HOUR_LOOKS == 0:
                    self._storage.retention.apply_daily()
            except Exception:
                _log.exception("could not look after the disk")
            looks += 1
