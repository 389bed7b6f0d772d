"""The keeper: a thread in which a lease expires, and a new loop hears which epoch to obey."""

import logging
from threading import Event, Thread

from app.authority.service import Authority

_log = logging.getLogger(__name__)
LOOK_S = 0.1


class LeaseKeeper:
    """Looks ten times a second, from `start` to `close`."""

    def __init__(self, authority: Authority) -> None:
        self._authority = authority
        self._ended = Event()
        self._thread = Thread(target=self._keep, name="lease", daemon=True)

    def start(self) -> None:
        """Begin to look."""
        self._thread.start()

    def close(self) -> None:
        """End the thread."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def _keep(self) -> None:
        while not self._ended.wait(LOOK_S):
            try:
                self._authority.look()
            except Exception:
                _log.exception("could not look after the lease")
