"""`WS /api/v1/live`. Origin and credentials have been checked before (`app.security`, `app.access.door`)."""

import asyncio
import logging
from collections.abc import Callable
from functools import partial

from fastapi import APIRouter, WebSocket

from app.access.dependencies import AccessService, Viewer
from app.access.door import NOT_IN
from app.access.principal import Principal
from app.access.sockets import until_sent_away
from app.authority.service import Authority
from app.definitions.limits import RIG
from app.dependencies import ThisConsole
from app.live.client import Client, TooSlow
from app.live.messages import Beat, ErrorFrame, Hello, Subscribe, parse
from app.settings import VERSION

router = APIRouter()
_log = logging.getLogger(__name__)
TRY_AGAIN_LATER = 1013


@router.websocket("/api/v1/live")
async def live(who: Viewer, socket: WebSocket, stream: ThisConsole, access: AccessService) -> None:
    """The live stream, as docs/wire.md has it."""
    await socket.accept()
    client = Client()
    client.put_message(Hello(period_s=RIG.period_s, version=VERSION).model_dump_json())
    stream.broadcaster.add(client)
    sent_away = asyncio.create_task(until_sent_away(who, access.book))
    hear = partial(_hear, client, who, stream.authority)
    jobs = (client.send(socket), _listen(socket, hear))
    tasks = [sent_away, *(asyncio.create_task(job) for job in jobs)]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        if sent_away in done:
            await socket.close(NOT_IN, "signed out")
        elif any(isinstance(task.exception(), TooSlow) for task in done):
            _log.warning("a browser left too many events unread: closed")
            await socket.close(TRY_AGAIN_LATER, "too many events unread")
    finally:
        stream.broadcaster.remove(client)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def _hear(client: Client, who: Principal, authority: Authority, text: str | None) -> None:
    """Do what a frame of the browser's asks for, or say why not."""
    wanted = parse(text)
    if isinstance(wanted, Subscribe):
        client.subscribe(wanted)
        return
    refusal = authority.beat(who, wanted.epoch) if isinstance(wanted, Beat) else wanted
    if refusal is not None:
        error = ErrorFrame(code=refusal.code, detail=refusal.detail)
        client.put_message(error.model_dump_json())


async def _listen(socket: WebSocket, hear: Callable[[str | None], None]) -> None:
    """Read the browser's frames until it leaves."""
    while True:
        try:
            frame = await socket.receive()
        except RuntimeError:
            return
        if frame["type"] == "websocket.disconnect":
            return
        hear(frame.get("text"))
