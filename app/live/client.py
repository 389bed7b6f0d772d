"""One browser on the live stream, with its own bounded queue."""

import asyncio
from collections import deque
from collections.abc import Hashable
from typing import Protocol

from app.live.frame import Stretch
from app.live.messages import Subscribe

MOST_FRAMES = 32  # of samples, about a second
MOST_MESSAGES = 1000  # events are not dropped: who leaves so many unread is sent away


class Socket(Protocol):
    """What a client sends through."""

    async def send_text(self, data: str) -> None: ...

    async def send_bytes(self, data: bytes) -> None: ...


class TooSlow(Exception):
    """The browser has left too many events unread."""


class Client:
    """Samples: dropped when the queue is full, and counted. Status and points: the newest wins. Events: kept."""

    def __init__(self) -> None:
        self._messages: deque[str] = deque()
        self._status: str | None = None
        self._points: dict[Hashable, str] = {}
        self._samples: deque[bytes] = deque()
        self._lost_ticks = 0
        self._wanted: Subscribe | None = None
        self._overflowed = False
        self._something = asyncio.Event()

    def subscribe(self, wanted: Subscribe) -> None:
        """Send these channels from now on. What waits of the ones before is not sent any more."""
        self._wanted = wanted
        self._samples.clear()
        self._lost_ticks = 0

    def put_message(self, text: str) -> None:
        """Send a message, after those before it."""
        if len(self._messages) >= MOST_MESSAGES:
            self._overflowed = True
        else:
            self._messages.append(text)
        self._something.set()

    def put_status(self, text: str) -> None:
        """Send the status, instead of one that still waits."""
        self._status = text
        self._something.set()

    def put_point(self, key: Hashable, text: str) -> None:
        """Send a point of a frequency response, instead of one of the same key that still waits."""
        self._points[key] = text
        self._something.set()

    def put_samples(self, stretch: Stretch, lost_ticks: int) -> None:
        """Send consecutive ticks; `lost_ticks` before them were missed by everybody."""
        wanted = self._wanted
        if wanted is None or not wanted.channels:
            return
        self._lost_ticks += lost_ticks
        if len(self._samples) >= MOST_FRAMES:
            self._lost_ticks += len(stretch.records)
            return
        self._samples.append(stretch.frame(wanted.channels, self._lost_ticks, wanted.subscription))
        self._lost_ticks = 0
        self._something.set()

    async def send(self, socket: Socket) -> None:
        """Send whatever there is, for ever. Raises `TooSlow`, or what the socket raises."""
        while True:
            await self._something.wait()
            self._something.clear()
            await self.send_waiting(socket)

    async def send_waiting(self, socket: Socket) -> None:
        """Send what waits now, and what comes meanwhile. Raises as `send` does."""
        while await self._send_next(socket):
            pass

    async def _send_next(self, socket: Socket) -> bool:
        if self._overflowed:
            raise TooSlow
        if self._messages:
            await socket.send_text(self._messages.popleft())
        elif self._status is not None:
            status, self._status = self._status, None
            await socket.send_text(status)
        elif self._points:
            await socket.send_text(self._points.pop(next(iter(self._points))))
        elif self._samples:
            await socket.send_bytes(self._samples.popleft())
        else:
            return False
        return True
