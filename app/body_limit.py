"""How much a request may send: more is refused as soon as it is known, and never kept."""

from collections.abc import Mapping

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import Code, Refusal
from app.problems import problem

MOST_BYTES = 4_000_000
_MEGABYTE = 1e6


class BodyLimit:
    """ASGI middleware that refuses long bodies. `limits` holds other limits, by path; None: none."""

    def __init__(self, app: ASGIApp, limits: Mapping[str, int | None]) -> None:
        self._app = app
        self._limits = limits

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        limit = self._limits.get(scope.get("path", ""), MOST_BYTES)
        if scope["type"] != "http" or limit is None:
            await self._app(scope, receive, send)
            return
        if _announced(scope) > limit:
            await _refuse(scope, receive, send, limit)
            return
        counted = _Counted(receive, send, limit)
        try:
            await self._app(scope, counted.receive, counted.send)
        except _TooLong:
            if not counted.answered:
                await _refuse(scope, receive, send, limit)


class _TooLong(BaseException):
    """More came than may; no handler of the application's is to take it for a failure of its own."""


class _Counted:
    def __init__(self, receive: Receive, send: Send, limit: int) -> None:
        self._receive, self._send, self._left = receive, send, limit
        self.answered = False

    async def receive(self) -> Message:
        message = await self._receive()
        self._left -= len(message.get("body", b""))
        if self._left < 0:
            raise _TooLong
        return message

    async def send(self, message: Message) -> None:
        self.answered = True
        await self._send(message)


def _announced(scope: Scope) -> int:
    length = Headers(scope=scope).get("content-length", "")
    return int(length) if length.isdecimal() else 0


async def _refuse(scope: Scope, receive: Receive, send: Send, limit: int) -> None:
    detail = f"More than {limit / _MEGABYTE:g} MB were sent, which is the limit here: send less"
    response = problem(Refusal(Code.TOO_LARGE, detail, about={"limit_bytes": limit}))
    response.headers["Connection"] = "close"  # the rest of the body stays unread
    await response(scope, receive, send)
