"""Connections to the console: bounded in number, and in how long a request's head may take to come.

A connection that says nothing would otherwise be held for ever, and the console has only so many files.
"""

import asyncio
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

HEAD_S = 20.0  # for the head of a request: who is slower is sent away
MOST = 400


class BoundedProtocol(H11Protocol):
    """Uvicorn's HTTP, which waits for a head no longer than that; of too many connections an idle one goes."""

    _head_timer: asyncio.TimerHandle | None = None

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
        super().connection_lost(exc)

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
