"""The door: nothing under `/api`, `/scene` or `/metrics` is asked, and no body read, before it is known who asks."""

import logging
from collections.abc import Mapping
from typing import Any, cast

from sqlalchemy.exc import SQLAlchemyError
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Receive, Scope, Send

from app.access.credentials import cookie_name, credentials_in
from app.access.principal import Principal
from app.access.service import Access
from app.audit.actor import Actor, acting
from app.errors import Code, Refusal
from app.problems import problem

SIGN_IN = "/api/v1/auth/login"
NOT_IN = 4401  # close code of a socket whose credential is not good, or no longer
_GUARDED = ("/api/", "/scene", "/metrics")
SAFE = frozenset({"GET", "HEAD", "OPTIONS"})
_NO_ANSWER = Refusal(
    Code.DATABASE_UNAVAILABLE, "The database does not answer: try again in a moment"
)
_log = logging.getLogger(__name__)


def principal_of(scope: Mapping[str, Any]) -> Principal | None:
    """Who asks, None where the door did not need to know."""
    return cast(Principal | None, scope.get("state", {}).get("principal"))


def cookie_of(scope: Mapping[str, Any]) -> str:
    """The name of the cookie of this console's sessions."""
    port = (scope.get("server") or ("", 0))[1] or 0
    return cookie_name(port, secure=is_secure(scope))


def is_secure(scope: Mapping[str, Any]) -> bool:
    """Whether it came over TLS."""
    return scope.get("scheme") in ("https", "wss")


class Door:
    """ASGI middleware that lets in who has shown who they are, and notes it for routers and audit."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan" or _is_open(scope["path"]):
            await self._app(scope, receive, send)
            return
        who = await _who(scope)
        if isinstance(who, Principal):
            scope.setdefault("state", {})["principal"] = who
            if scope["type"] == "http":
                scope["app"].state.console.authority.seen(who)  # whoever asks is there
            with acting(Actor(who.name, who.role.word, who.id)):
                await self._app(scope, receive, send)
        elif scope["type"] == "http":
            await problem(who)(scope, receive, send)
        else:
            await receive()
            await send({"type": "websocket.close", "code": NOT_IN, "reason": who.detail})


def _is_open(path: str) -> bool:
    return path == SIGN_IN or not path.startswith(_GUARDED)


async def _who(scope: Scope) -> Principal | Refusal:
    connection = HTTPConnection(scope)
    query = scope["query_string"] if scope["type"] == "websocket" else b""
    brought = credentials_in(connection.headers, connection.cookies, query, cookie_of(scope))
    if isinstance(brought, Refusal):
        return brought
    access = cast(Access, scope["app"].state.console.access)
    changes = scope["type"] == "http" and scope["method"] not in SAFE
    try:
        return await access.identity.who(brought, changes=changes)
    except SQLAlchemyError as error:
        _log.error("access: %s", error)
        return _NO_ANSWER
