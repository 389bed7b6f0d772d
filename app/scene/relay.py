"""Between a browser and the scene: frames go through as they are, at the pace of the slower."""

import asyncio
import contextlib
from collections.abc import Coroutine
from typing import Any

from fastapi import WebSocket
from websockets.asyncio.client import ClientConnection
from websockets.exceptions import ConnectionClosed

STALL_S = 10.0  # a browser that takes nothing for so long is sent away


async def relay(
    browser: WebSocket, scene: ClientConnection, sent_away: Coroutine[Any, Any, None]
) -> bool:
    """Until one of the two goes, or `sent_away` returns: then it is true."""
    ended = asyncio.create_task(sent_away)
    tasks = [ended, *(asyncio.create_task(way(browser, scene)) for way in (_to_browser, _to_scene))]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        return ended.done()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def _to_browser(browser: WebSocket, scene: ClientConnection) -> None:
    with contextlib.suppress(ConnectionClosed, RuntimeError, TimeoutError):
        async for frame in scene:
            if isinstance(frame, bytes):
                await asyncio.wait_for(browser.send_bytes(frame), STALL_S)


async def _to_scene(browser: WebSocket, scene: ClientConnection) -> None:
    with contextlib.suppress(ConnectionClosed, RuntimeError):
        while (frame := await browser.receive())["type"] == "websocket.receive":
            if frame.get("bytes") is None:
                return  # viser's page sends no text
            await scene.send(frame["bytes"])
