"""What must be had before the console can serve: the data directory for itself, and the port."""

import errno
import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from app.link.paths import block_path
from app.link.supervisor import BlockError, left_over
from app.settings import Settings

_BACKLOG = 256


class CannotServe(Exception):
    """The console cannot start; the message says why and what to do, in one line."""


@contextmanager
def hold_data_folder(folder: Path) -> Iterator[None]:
    """Hold the data directory, made where it is missing, against a second console."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = (folder / "console.lock").open("ab")
    except OSError as error:
        raise CannotServe(f"cannot use the data directory {folder}: {error.strerror}") from error
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise CannotServe(
                f"another console uses the data directory {folder}: stop it, "
                "or give another with --data"
            ) from None
        yield


def check(settings: Settings) -> None:
    """That no loop of another version runs on the block of this data directory."""
    try:
        left_over(block_path(settings.data_dir))
    except (BlockError, OSError) as error:
        raise CannotServe(str(error)) from error


@contextmanager
def bind(host: str, port: int) -> Iterator[socket.socket]:
    """A socket that listens there. Port 0 takes any free port."""
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
    except socket.gaierror as error:
        raise CannotServe(f"--host {host}: {error.strerror}") from error
    with socket.socket(family, kind, protocol) as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind(address)
            listener.listen(_BACKLOG)
        except OSError as error:
            raise CannotServe(_why_not_bound(host, port, error)) from error
        listener.setblocking(False)
        yield listener


def _why_not_bound(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"port {port} is taken: give another with --port, or --port 0 for any free one"
    if error.errno == errno.EACCES:
        return f"port {port} needs more rights: give one above 1023 with --port"
    return f"cannot listen on {host}:{port}: {os.strerror(error.errno or 0)}"


def url_of(listener: socket.socket) -> str:
    """The address to open in a browser."""
    host, port = listener.getsockname()[:2]
    if host in ("0.0.0.0", "::"):
        host = "localhost"
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"
