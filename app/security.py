"""Who may ask at all: the host that was asked for, the origin of who asks, and headers on the answers."""

import ipaddress
import socket
from collections.abc import Collection, Iterable
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import Code, Refusal
from app.problems import problem

_SAFE = frozenset({"GET", "HEAD", "OPTIONS"})
_POLICY = "; ".join(
    (
        "default-src 'self'",
        "style-src 'self' 'unsafe-inline'",  # Svelte and uPlot place things by style attributes
        "img-src 'self' data: blob:",
        "connect-src 'self'{stop}",
        "object-src 'none'",
        "base-uri 'none'",
        "form-action 'self'",
        "frame-ancestors 'none'",
    )
)
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), display-capture=(), geolocation=(), microphone=(), "
    "payment=(), serial=(), usb=()",
}
_UNDER_TLS = {"Strict-Transport-Security": "max-age=31536000"}
_OF_PERSONS = {"Cache-Control": "no-store"}  # what one user may read is not kept for the next


def known_hosts(configured: Iterable[str]) -> frozenset[str]:
    """The names under which this machine may be asked, besides its addresses."""
    return frozenset({"localhost", socket.gethostname().lower(), *(h.lower() for h in configured)})


def _host_name(host: str) -> str:
    return (urlsplit(f"//{host}").hostname or "").lower()


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def is_known_host(host: str, hosts: Collection[str]) -> bool:
    """Whether this machine may be asked under a Host header's name. Raises `ValueError` where it is none."""
    name = _host_name(host)
    return name in hosts or _is_address(name)


def refuse(
    method: str, headers: Headers, hosts: Collection[str], *, socket: bool
) -> Refusal | None:
    """Why a request is refused, None where it may pass.

    A name that is not this machine's comes from DNS rebinding; a foreign origin on anything that
    changes the rig comes from another site's page. What is not a browser sends no origin.
    """
    host, origin = headers.get("host", ""), headers.get("origin")
    try:
        name = _host_name(host)
        theirs = None if origin is None else urlsplit(origin).netloc.lower()
    except ValueError:
        return Refusal(Code.UNKNOWN_HOST, "The host or origin of this request cannot be read")
    if not is_known_host(host, hosts):
        detail = f"This console is not known as {name!r}: add the name to FORCERIG_ALLOWED_HOSTS"
        return Refusal(Code.UNKNOWN_HOST, detail)
    if method in _SAFE and not socket:
        return None
    foreign = theirs is not None and theirs != host.lower()
    if foreign or headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
        return Refusal(Code.FOREIGN_ORIGIN, "Only the console's own pages may do this")
    return None


class Guard:
    """ASGI middleware that refuses foreign requests, and puts security headers on every answer.

    `stop_port` is that of Stop's own path, which the console's pages may ask too.
    """

    def __init__(self, app: ASGIApp, hosts: Collection[str], stop_port: int | None = None) -> None:
        self._app = app
        self._hosts = hosts
        self._stop_port = stop_port

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        is_socket = scope["type"] == "websocket"
        refusal = refuse(
            scope.get("method", "GET"), Headers(scope=scope), self._hosts, socket=is_socket
        )
        if is_socket:
            if refusal is None:
                await self._app(scope, receive, send)
            else:
                await receive()
                await send({"type": "websocket.close", "code": 1008, "reason": refusal.detail})
            return
        app = self._app if refusal is None else problem(refusal)
        stop = self._stop_path(scope) if refusal is None else ""
        await app(scope, receive, _with_headers(send, _headers_for(scope, stop)))

    def _stop_path(self, scope: Scope) -> str:
        """As the policy names it. A policy cannot name an address of IPv6: there, pages go without."""
        name = _host_name(Headers(scope=scope).get("host", ""))
        known = self._stop_port is not None and ":" not in name
        return f" {scope.get('scheme', 'http')}://{name}:{self._stop_port}" if known else ""


def _headers_for(scope: Scope, stop: str) -> dict[str, str]:
    of_persons = scope["path"].startswith(("/api/", "/sign-in"))
    tls = scope.get("scheme") == "https"
    policy = {"Content-Security-Policy": _POLICY.format(stop=stop)}
    return policy | _HEADERS | (_UNDER_TLS if tls else {}) | (_OF_PERSONS if of_persons else {})


def _with_headers(send: Send, wanted: dict[str, str]) -> Send:
    async def wrapped(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in wanted.items():
                headers.setdefault(name, value)
        await send(message)

    return wrapped
