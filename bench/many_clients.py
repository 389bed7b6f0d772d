"""So many browsers on the live stream of a console: `python -m bench.many_clients URL TOKEN CLIENTS SECONDS`.

Prints one JSON document: of each client the ticks it was sent, and those it was told it had lost.
"""

import asyncio
import json
import struct
import sys
from typing import Any

from websockets.asyncio.client import ClientConnection, connect

HEADER = struct.Struct("<BBHIqII")
WATCHED = ("force_command_n", "force_n", "displacement_m", "valve_command", "pressure_1_pa")


class Watching:
    """One client that keeps up, and what it has seen."""

    def __init__(self) -> None:
        self.ticks = 0
        self.lost = 0
        self.first: int | None = None
        self.last = 0

    async def read(self, stream: ClientConnection) -> None:
        async for frame in stream:
            if isinstance(frame, bytes):
                _, _, _, samples, tick, lost, _ = HEADER.unpack_from(frame)
                if self.first is None:
                    self.first = tick
                else:
                    self.lost += lost
                self.ticks += samples
                self.last = tick + samples


async def subscribe(url: str, token: str) -> ClientConnection:
    credentials = {"Authorization": f"Bearer {token}"}
    stream = await connect(url, additional_headers=credentials, max_size=None, compression=None)
    wanted = {"type": "subscribe", "subscription": 1, "channels": WATCHED}
    await stream.send(json.dumps(wanted))
    return stream


async def stall(url: str, token: str) -> ClientConnection:
    """A client that subscribes and then takes nothing off its socket any more."""
    stream = await subscribe(url, token)
    stream.transport.pause_reading()
    return stream


async def watch(url: str, token: str, clients: int, seconds: float) -> dict[str, Any]:
    """Watch, all at once, beside one that has stalled."""
    stalled = await stall(url, token)
    streams = [await subscribe(url, token) for _ in range(clients)]
    watching = [Watching() for _ in streams]
    readers = [
        asyncio.create_task(one.read(stream)) for one, stream in zip(watching, streams, strict=True)
    ]
    print("watching", file=sys.stderr, flush=True)
    await asyncio.sleep(seconds)
    for reader in readers:
        reader.cancel()
    await asyncio.gather(*readers, return_exceptions=True)
    for stream in (*streams, stalled):
        stream.transport.abort()
    return {
        "clients": [
            {"ticks": one.ticks, "lost": one.lost, "first": one.first, "last": one.last}
            for one in watching
        ]
    }


if __name__ == "__main__":
    _, address, bearer, how_many, how_long = sys.argv
    print(json.dumps(asyncio.run(watch(address, bearer, int(how_many), float(how_long)))))
