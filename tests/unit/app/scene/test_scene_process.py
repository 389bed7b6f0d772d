"""The scene's process: what a killed console has left is swept, and who comes too early is told so."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any, cast

import pytest
from fastapi import WebSocket

from app.access.principal import Principal, Role
from app.errors import Code, Refusal
from app.scene.chain import Chain
from app.scene.keeper import Keeper
from app.scene.moments import reading_now
from app.scene.router import look
from rtcore.rig.parameters import rig_from

START_S = 110.0


@pytest.mark.process
def test_it_listens_in_a_folder_of_its_own_however_deep_and_leaves_nothing(tmp_path: Path) -> None:
    data = tmp_path / ("deep" * 30)
    left = data / "scene" / "left-by-a-killed-console"
    left.mkdir(parents=True)

    async def look_at_it() -> None:
        keeper = Keeper(data, lambda: Chain.of(rig_from({})), lambda: reading_now(None))
        keeper.start()
        assert not left.parent.exists()
        try:
            process = await keeper.until_ready(START_S)
            assert process is not None
            assert left.parent.stat().st_mode & 0o077 == 0
            _, writer = await asyncio.open_unix_connection(process.socket)
            writer.close()
        finally:
            await keeper.stop()

    asyncio.run(look_at_it())
    assert not left.parent.exists()


class NotYet:
    """A scene that is starting."""

    @asynccontextmanager
    async def looking(self, *who: Any) -> AsyncIterator[Refusal]:
        yield Refusal(Code.BUSY, "It is starting: try again", about={"retry_after_s": 2})


def test_who_comes_too_early_is_told_to_try_again() -> None:
    sent: list[dict[str, Any]] = []

    async def receive() -> dict[str, str]:
        return {"type": "websocket.connect"}

    async def send(message: dict[str, Any]) -> None:
        sent.append(message)

    scope = {"type": "websocket", "subprotocols": [], "extensions": {"websocket.http.response": {}}}
    socket = WebSocket(scope, receive, cast(Any, send))
    who = Principal("session:1", "a", Role.VIEWER, "session", 1)

    async def come() -> None:
        await socket.receive()
        await look(who, socket, cast(Any, NotYet()), cast(Any, None))

    asyncio.run(come())
    start, body = sent
    assert (start["type"], start["status"]) == ("websocket.http.response.start", 503)
    assert (b"retry-after", b"2") in start["headers"]
    assert b"try again" in body["body"]
