"""How fast a client may ask: generous, and never in the way of Stop."""

import math
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from starlette.types import ASGIApp, Receive, Scope, Send

from app.errors import Code, Refusal
from app.problems import problem

PER_S = 200.0
AT_ONCE = 2000.0
_MOST_KEPT = 10_000


@dataclass
class _Client:
    left: float
    at_s: float


class Pace:
    """How many requests each client has left. They come back at a steady rate."""

    def __init__(
        self,
        per_s: float = PER_S,
        at_once: float = AT_ONCE,
        clock_s: Callable[[], float] = time.monotonic,
    ) -> None:
        self._per_s, self._at_once, self._clock_s = per_s, at_once, clock_s
        self._clients: OrderedDict[str, _Client] = OrderedDict()

    def take(self, address: str) -> Refusal | None:
        """Count a request; refused where none is left."""
        now_s = self._clock_s()
        client = self._clients.pop(address, None) or _Client(self._at_once, now_s)
        self._clients[address] = client
        if len(self._clients) > _MOST_KEPT:
            self._clients.popitem(last=False)
        client.left = min(self._at_once, client.left + (now_s - client.at_s) * self._per_s)
        client.at_s = now_s
        if client.left < 1.0:
            seconds = math.ceil((1.0 - client.left) / self._per_s)
            detail = f"Too many requests: {self._per_s:.0f} a second are answered, wait {seconds} s"
            return Refusal(Code.TOO_MANY_REQUESTS, detail, about={"retry_after_s": seconds})
        client.left -= 1.0
        return None


class Paced:
    """ASGI middleware that refuses what comes too fast. `never` are paths that it lets through."""

    def __init__(self, app: ASGIApp, never: frozenset[str]) -> None:
        self._app = app
        self._never = never
        self._pace = Pace()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan" or scope["path"] in self._never:
            await self._app(scope, receive, send)
            return
        refusal = self._pace.take((scope.get("client") or ("",))[0])
        if refusal is None:
            await self._app(scope, receive, send)
        elif scope["type"] == "http":
            await problem(refusal)(scope, receive, send)
        else:
            await receive()
            await send({"type": "websocket.close", "code": 1013, "reason": refusal.detail})
