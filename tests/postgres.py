"""A PostgreSQL server of the tests' own: private, on a socket in a temporary folder, gone with them."""

import ctypes
import os
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path

import psycopg

from tools.ensure_postgres import find

PATIENCE_S = 60.0
USER = "forcerig"
_UNPRIVILEGED = "nobody"  # PostgreSQL refuses to run as root
_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None, use_errno=True)


def programs() -> Path | None:
    """The folder of initdb and postgres, None where there is no server."""
    given = os.environ.get("FORCERIG_POSTGRES")
    found = Path(given) if given else None if (folder := find()) is None else Path(folder)
    return found if found and (found / "initdb").exists() else None


class Server:
    """A running server that makes databases."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._numbers = count(1)

    def url(self, database: str) -> str:
        """How SQLAlchemy reaches a database of this server."""
        return f"postgresql://{USER}@/{database}?host={self._folder}"

    def new_database(self, template: str = "template0") -> str:
        """A database that nobody else uses; returns its name."""
        name = f"test_{next(self._numbers)}"
        with self.connect() as connection:
            connection.execute(f"CREATE DATABASE {name} TEMPLATE {template}".encode())
        return name

    def connect(self, database: str = "postgres") -> "psycopg.Connection[tuple[object, ...]]":
        """A connection beside all others."""
        return psycopg.connect(host=str(self._folder), user=USER, dbname=database, autocommit=True)


@contextmanager
def serving(bin_folder: Path) -> Iterator[Server]:
    """Make a cluster, serve it, and leave nothing of it.

    It sorts text as English does, so that a query that leans on the order of bytes is found out.
    """
    folder = Path(tempfile.mkdtemp(prefix="forcerig-pg-"))
    user = _UNPRIVILEGED if os.geteuid() == 0 else None
    if user is not None:
        shutil.chown(folder, user)
    data = folder / "data"
    sorting = ("--locale=C.UTF-8", "--locale-provider=icu", "--icu-locale=en-US")
    init: list[Path | str] = [
        bin_folder / "initdb",
        "-D",
        data,
        "-U",
        USER,
        "-A",
        "trust",
        "-E",
        "UTF8",
        "-N",
    ]
    process: subprocess.Popen[bytes] | None = None
    try:
        subprocess.run([*init, *sorting], user=user, cwd=folder, check=True, capture_output=True)
        settings = {
            "listen_addresses": "",
            "unix_socket_directories": str(folder),
            "fsync": "off",
            "timezone": "Asia/Tokyo",  # that of a server is not to matter
        }
        options = [part for item in settings.items() for part in ("-c", "=".join(item))]
        with (folder / "log").open("wb") as log:
            process = subprocess.Popen(
                [bin_folder / "postgres", "-D", data, *options],
                user=user,
                cwd=folder,
                stdout=log,
                stderr=log,
                preexec_fn=_end_with_parent,
            )
        server = Server(folder)
        _wait_until_it_answers(server, process, folder / "log")
        yield server
    finally:
        if process is not None:
            process.send_signal(signal.SIGQUIT)  # at once: nothing in it is to be kept
            process.wait(PATIENCE_S)
        shutil.rmtree(folder, ignore_errors=True)


def _end_with_parent() -> None:
    _LIBC.prctl(_SET_PDEATHSIG, signal.SIGQUIT)


def _wait_until_it_answers(server: Server, process: "subprocess.Popen[bytes]", log: Path) -> None:
    give_up = time.monotonic() + PATIENCE_S
    while True:
        try:
            server.connect().close()
        except psycopg.OperationalError:
            assert process.poll() is None, log.read_text()
            assert time.monotonic() < give_up, log.read_text()
            time.sleep(0.05)
        else:
            return
