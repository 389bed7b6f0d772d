"""Where the path of its own is found: a port beside the console's, on the same host."""

import logging
import socket
import ssl
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

from app.serving import CannotServe, bind, url_of
from app.settings import Settings

_log = logging.getLogger(__name__)
_LAST_PORT = 65535


@dataclass(frozen=True)
class StopDoor:
    """A socket that listens for Stop, and the port of the console whose pages may ask."""

    listener: socket.socket
    console_port: int
    tls: ssl.SSLContext | None = None

    @property
    def port(self) -> int:
        return int(self.listener.getsockname()[1])

    @property
    def url(self) -> str:
        """Where to ask. A browser takes the name under which it has found the console."""
        return f"{url_of(self.listener, tls=self.tls is not None)}stop"


def wanted_port(settings: Settings) -> int:
    """The port that it should have; 0 is any free one."""
    if settings.stop_port is not None:
        return settings.stop_port
    return settings.port + 1 if settings.port else 0


@contextmanager
def open_door(settings: Settings, console: socket.socket) -> Iterator[StopDoor | None]:
    """The door beside the console's listener. None, with a word in the log, where it cannot be had."""
    with ExitStack() as held:
        yield _door(settings, console, held)


def _door(settings: Settings, console: socket.socket, held: ExitStack) -> StopDoor | None:
    port = wanted_port(settings)
    try:
        if port > _LAST_PORT:
            raise CannotServe(f"there is no port {port}")
        listener = held.enter_context(bind(settings.host, port))
    except CannotServe as error:
        _log.warning("Stop has no path of its own (FORCERIG_STOP_PORT gives it a port): %s", error)
        return None
    listener.setblocking(True)
    return StopDoor(listener, int(console.getsockname()[1]), _tls(settings))


def _tls(settings: Settings) -> ssl.SSLContext | None:
    if settings.tls_cert is None:
        return None
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(settings.tls_cert, settings.tls_key)
    return context
