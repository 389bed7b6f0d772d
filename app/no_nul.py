"""No request names the one character that PostgreSQL does not know: NUL, in its path or its query."""

from starlette.types import ASGIApp, Receive, Scope, Send

from app.errors import Code, Refusal
from app.problems import problem

_NUL = b"%00"  # how an address says it


class NoNul:
    """ASGI middleware that refuses it, so that both databases answer alike. Bodies are checked by their fields."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        app = self._app
        if scope["type"] == "http" and (_NUL in scope["query_string"] or "\0" in scope["path"]):
            app = problem(Refusal(Code.INVALID_REQUEST, "An address must not contain NUL (%00)"))
        await app(scope, receive, send)
