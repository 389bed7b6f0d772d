"""viser without a port: it takes any page of any origin, so it listens where no page can ask at all.

A Unix socket in a folder of the console's own. Who looks is named in the address that the console's
proxy asks for; viser itself does not tell its callbacks.
"""

from collections.abc import Awaitable, Callable
from contextvars import ContextVar
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote

import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection

looking: ContextVar[str] = ContextVar("looking")  # the name of the view, in viser's async callbacks
MOST_RECEIVED_BYTES = 65_536  # a browser tells where its camera is, no more


def address_of(view: str) -> str:
    """What the proxy asks for, for a view of this name."""
    return f"ws://scene/{quote(view, safe='')}"


def listen_at(path: Path) -> None:
    """Have every server that is started from now on in this process listen there, and serve no files."""

    theirs = websockets.asyncio.server.serve

    def serve(
        handler: Callable[[ServerConnection], Awaitable[None]], host: str, port: int, **options: Any
    ) -> Any:
        async def named(connection: ServerConnection) -> None:
            assert connection.request is not None
            looking.set(unquote(connection.request.path.removeprefix("/")))
            await handler(connection)

        ours = {"process_request": None, "max_size": MOST_RECEIVED_BYTES}
        return theirs(named, unix=True, path=str(path), **options | ours)

    websockets.asyncio.server.serve = serve  # type: ignore[assignment,misc]
