"""The app's heartbeat: a plain thread, so that a busy event loop does not stop the load."""

from threading import Event, Thread
from time import monotonic_ns

from app.link.life import Life

PERIOD_S = 0.02


class Heartbeat:
    """Tells the loop that the app is there. Silent for 0.5 s, and the loop takes the load off."""

    def __init__(self) -> None:
        self._life: Life | None = None
        self._ended = Event()
        self._thread = Thread(target=self._beat, name="heartbeat", daemon=True)

    def start(self) -> None:
        """Begin to beat."""
        self._thread.start()

    def turn_to(self, life: Life | None) -> None:
        """Beat in the block of this life from now on, its first beat being done at once."""
        if life is not None:
            life.block.fields["app_heartbeat_ns"] = monotonic_ns()
        self._life = life

    def stop(self) -> None:
        """Fall silent."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def _beat(self) -> None:
        while not self._ended.wait(PERIOD_S):
            life = self._life
            if life is not None:
                life.block.fields["app_heartbeat_ns"] = monotonic_ns()
