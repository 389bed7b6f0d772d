"""Drains the ring once for all browsers, about 30 times a second."""

import asyncio
import logging
from collections import deque
from collections.abc import Callable, Hashable

from app.link.events import EventReader
from app.link.life import Life, RingReader
from app.live.client import Client
from app.live.frame import Stretch
from app.live.messages import EventFrame, EventOut, RunsChanged, StatusFrame
from app.rigs.schemas import RigStatus

_log = logging.getLogger(__name__)
FRAME_S = 1 / 30
STATUS_S = 0.1
MOST_TICKS = 4000  # in a frame: one second after a pause of ours


class Broadcaster:
    """One task of the event loop; reading the ring and filling the queues never waits."""

    def __init__(self, life: Callable[[], Life | None], status: Callable[[], RigStatus]) -> None:
        self._life = life
        self._status = status
        self._following: Life | None = None
        self._samples: RingReader | None = None
        self._events: EventReader | None = None
        self._clients: set[Client] = set()
        self._runs_changed = False
        self._told: deque[tuple[str, str, str]] = deque()
        self._points: deque[tuple[Hashable, str]] = deque()
        self._task: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Begin to broadcast."""
        self._task = asyncio.get_running_loop().create_task(self._broadcast())

    async def stop(self) -> None:
        """End the task."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)

    def add(self, client: Client) -> None:
        """Send to this client too, beginning with the status as it is."""
        client.put_status(self._status_text())
        self._clients.add(client)

    def remove(self, client: Client) -> None:
        """Send to this client no more."""
        self._clients.discard(client)

    def clients(self) -> int:
        """How many there are."""
        return len(self._clients)

    def runs_changed(self) -> None:
        """Tell everybody that the list of runs has changed. From any thread."""
        self._runs_changed = True

    def tell(self, kind: str, code: str, text: str) -> None:
        """Tell everybody of something that the app did, like an event of the loop. From any thread."""
        self._told.append((kind, code, text))

    def tell_point(self, key: Hashable, text: str) -> None:
        """Tell everybody of a point of a frequency response, instead of one of the same key. From any thread."""
        self._points.append((key, text))

    async def _broadcast(self) -> None:
        clock = asyncio.get_running_loop().time
        status_due = clock()
        while True:
            await asyncio.sleep(FRAME_S)
            try:
                self.pump()
                if clock() >= status_due:
                    status_due = max(status_due + STATUS_S, clock())
                    self._put_status()
            except Exception:  # the stream goes on whatever one frame had
                _log.exception("live stream")

    def pump(self) -> None:
        """Give every client what has happened since the last call."""
        self._follow(self._life())
        if self._runs_changed:
            self._runs_changed = False
            self._put_message(RunsChanged().model_dump_json())
        if self._events is not None:
            for event in self._events.read():
                if event.kind != "lease":  # which is told with names
                    self._put_message(EventFrame.of(event).model_dump_json())
        self._put_told()
        while self._points:
            key, text = self._points.popleft()
            for client in self._clients:
                client.put_point(key, text)
        if self._samples is not None:
            batch = self._samples.read(MOST_TICKS)
            if len(batch.records):
                stretch = Stretch(batch.records)
                for client in self._clients:
                    client.put_samples(stretch, batch.lost)

    def _put_told(self) -> None:
        life = self._following
        while self._told:
            kind, code, text = self._told.popleft()
            tick = 0 if life is None else max(0, life.next_tick() - 1)
            time_s = 0.0 if life is None else tick * life.period_ns * 1e-9
            event = EventOut(tick=tick, time_s=time_s, kind=kind, code=code, text=text)
            self._put_message(EventFrame(event=event).model_dump_json())

    def _follow(self, life: Life | None) -> None:
        """Begin with what is published from now on, when there is a new loop."""
        if life is None or life is self._following:
            return
        self._following = life
        self._samples = life.telemetry()
        self._samples.position = self._samples.published
        self._events = EventReader(life)
        self._events.skip()

    def _put_message(self, text: str) -> None:
        for client in self._clients:
            client.put_message(text)

    def _put_status(self) -> None:
        if self._clients:
            text = self._status_text()
            for client in self._clients:
                client.put_status(text)

    def _status_text(self) -> str:
        return StatusFrame(status=self._status()).model_dump_json()
