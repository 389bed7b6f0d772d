"""Connections to the console: bounded in number, in how long a request's head may take to come, and in how
long an answer may lie unread.

A connection that says nothing would otherwise be held for ever, and the console has only so many files; a
download that nobody reads would keep others from theirs.
"""

import asyncio
import fcntl
import struct
import termios
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

HEAD_S = 20.0  # for the head of a request: who is slower is sent away
STALL_S = 15.0  # in which whoever is answered takes nothing of it: then they are sent away
MOST = 400


class BoundedProtocol(H11Protocol):
    """Uvicorn's HTTP, which waits no longer than that; of too many connections an idle one goes."""

    _head_timer: asyncio.TimerHandle | None = None
    _stall_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Take a connection, in the place of one that says nothing where there are too many."""
        if len(self.connections) >= MOST:
            idle = next((one for one in self.connections if _says_nothing(one)), None)
            if idle is None:
                transport.abort()
            else:
                idle.transport.abort()
        super().connection_made(transport)
        self._wait_for_head()

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        self._wait_for_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing more."""
        if self._head_timer is not None:
            self._head_timer.cancel()
        self._wait_for_reader_no_more()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """More is to be read than is kept for whoever is slow."""
        super().pause_writing()
        self._wait_for_reader()

    def resume_writing(self) -> None:
        """It has been read."""
        self._wait_for_reader_no_more()
        super().resume_writing()

    def _wait_for_reader(self) -> None:
        self._stall_timer = self.loop.call_later(STALL_S, self._look_at_reader, self._unread())

    def _wait_for_reader_no_more(self) -> None:
        if self._stall_timer is not None:
            self._stall_timer.cancel()

    def _look_at_reader(self, unread_bytes: int) -> None:
        """However slowly they read: who has read anything may go on."""
        if self._unread() < unread_bytes:
            self._wait_for_reader()
        else:
            self.transport.abort()

    def _unread(self) -> int:
        """Bytes that the other side has not taken yet, those that the kernel holds among them."""
        held = struct.pack("i", 0)
        held = fcntl.ioctl(self.transport.get_extra_info("socket"), termios.TIOCOUTQ, held)
        return int(self.transport.get_write_buffer_size() + struct.unpack("i", held)[0])

    def _wait_for_head(self) -> None:
        if self._head_timer is not None:
            self._head_timer.cancel()
        self._head_timer = self.loop.call_later(HEAD_S, self._send_away)

    def _send_away(self) -> None:
        if _says_nothing(self):
            self.transport.abort()


def _says_nothing(protocol: Any) -> bool:
    """Whether no whole head of a request has come on a connection, nor since its last answer."""
    return isinstance(protocol, BoundedProtocol) and protocol.conn.their_state is h11.IDLE
