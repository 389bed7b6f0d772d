"""What must be had before the console can serve: the data directory for itself, and the port."""

import errno
import fcntl
import logging
import os
import socket
import ssl
from collections.abc import Iterator
from contextlib import contextmanager
from ipaddress import ip_address
from pathlib import Path

from sqlalchemy import func, make_url, select
from sqlalchemy.exc import ArgumentError, OperationalError

from app.db import Database
from app.link.paths import block_path
from app.link.supervisor import BlockError, left_over
from app.settings import Settings

_BACKLOG = 256
_NICENESS = -10
_CONSOLE_LOCK = 0x666F726365726967  # "forcerig", of the advisory locks of a database


_log = logging.getLogger(__name__)


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


@contextmanager
def hold_database(address: str) -> Iterator[None]:
    """Hold a PostgreSQL database against a second console: each takes the other's runs for its own.

    A SQLite file lies in the data directory, which is held already, unless somebody moved it.
    """
    try:
        url = make_url(address)
    except ArgumentError:
        raise CannotServe("FORCERIG_DATABASE_URL is no URL of a database") from None
    kind = url.get_backend_name()
    if kind not in ("sqlite", "postgresql"):
        raise CannotServe(f"no database of the kind {kind}: use sqlite:/// or postgresql://")
    if kind == "sqlite":
        yield
        return
    database = Database(address)
    try:
        with database.engine.connect() as connection:
            if not connection.scalar(select(func.pg_try_advisory_lock(_CONSOLE_LOCK))):
                raise CannotServe(
                    f"another console uses the database {url.database}: a database each"
                )
            connection.commit()  # the lock is the session's, not the transaction's
            yield
    except OperationalError as error:
        first = str(error.orig).partition("\n")[0]
        raise CannotServe(f"cannot use the database {url.database}: {first}") from error
    finally:
        database.close()


def go_before_other_work() -> None:
    """Have the console's threads scheduled before ordinary work of this machine, where that is allowed.

    A heartbeat that is half a second late takes the load off. Threads begun later inherit it; the
    kernel weighs a session's processes as a group, so the group is told too.
    """
    try:
        os.setpriority(os.PRIO_PROCESS, 0, _NICENESS)
        group = Path("/proc/self/autogroup")
        if group.exists():
            group.write_text(str(_NICENESS))
    except OSError as error:
        _log.info("the console goes with other work, not before it: %s", error.strerror)


def check(settings: Settings) -> None:
    """That no loop of another version runs on the block of this data directory."""
    try:
        left_over(block_path(settings.data_dir))
    except (BlockError, OSError) as error:
        raise CannotServe(str(error)) from error


def check_exposure(settings: Settings) -> None:
    """That nobody's password goes over a network in clear, unless somebody said so in words."""
    if (settings.tls_cert is None) != (settings.tls_key is None):
        raise CannotServe("TLS needs both: give --tls-cert and --tls-key")
    if settings.tls_cert is not None and settings.tls_key is not None:
        _check_certificate(settings.tls_cert, settings.tls_key)
    elif not settings.plain_http and not _only_this_machine(settings.host):
        raise CannotServe(
            f"--host {settings.host} is reached from other machines, and passwords would go there "
            "in clear: give --tls-cert and --tls-key, or say --plain-http where the network is trusted"
        )


def _check_certificate(certificate: Path, key: Path) -> None:
    for file in (certificate, key):
        if not os.access(file, os.R_OK):
            raise CannotServe(f"cannot read {file}, which TLS needs")
    try:
        # A key with a password would be asked for on a terminal that may not be there.
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(certificate, key, password=lambda: "")
    except (ssl.SSLError, OSError) as error:
        raise CannotServe(
            f"{certificate} and {key} are no certificate (PEM) with its key without a password: "
            f"{error}"
        ) from None


def _only_this_machine(host: str) -> bool:
    try:
        found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    except socket.gaierror:
        return True  # `bind` says what is wrong with it
    return all(ip_address(address[0]).is_loopback for *_, address in found)


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


def url_of(listener: socket.socket, *, tls: bool = False) -> str:
    """The address to open in a browser."""
    scheme = "https" if tls else "http"
    host, port = listener.getsockname()[:2]
    if host in ("0.0.0.0", "::"):
        host = "localhost"
    return f"{scheme}://[{host}]:{port}/" if ":" in host else f"{scheme}://{host}:{port}/"
