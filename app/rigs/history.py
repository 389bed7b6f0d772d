"""What the status remembers of a life of the loop: its trips, its last change of mode, its rate."""

from collections import deque
from time import monotonic

from app.link.events import EventReader, LoopEvent
from app.link.life import Life

RATE_OVER_S = 1.0


class History:
    """Reads the events of one life of the loop as far as the status needs them."""

    def __init__(self, life: Life) -> None:
        self.life = life
        self._events = EventReader(life)
        self._trips: dict[int, LoopEvent] = {}
        self._mode_tick = 0
        self._ticks: deque[tuple[float, int]] = deque()

    def update(self, tick: int) -> None:
        """Read on; `tick` is the latest."""
        for event in self._events.read():
            if event.kind == "trip":
                self._trips[event.detector] = event
            elif event.kind == "mode":
                self._mode_tick = event.tick
        now = monotonic()
        self._ticks.append((now, tick))
        while now - self._ticks[0][0] > RATE_OVER_S and len(self._ticks) > 2:
            self._ticks.popleft()

    def trip(self, detector: int) -> LoopEvent | None:
        """The last trip of a detector."""
        return self._trips.get(detector)

    def ticks_in_mode(self, tick: int) -> int:
        """How long the loop has been in its mode."""
        return tick - self._mode_tick

    def rate_hz(self) -> float | None:
        """Ticks a second, over the last one; None until it can be told."""
        (began, first), (now, last) = self._ticks[0], self._ticks[-1]
        return (last - first) / (now - began) if now - began > 0.1 else None
