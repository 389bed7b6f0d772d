"""A file of acts that are not in the database yet, a line each: what is in it survives the console."""

import json
import logging
import os
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from threading import Lock
from typing import IO, NamedTuple

from app.audit.entry import Act

_log = logging.getLogger(__name__)
SPOOL_FILE = "audit-spool.jsonl"


class Batch(NamedTuple):
    """The oldest acts, and where in the file they end."""

    acts: list[Act]
    end: int


class Spool:
    """May be used from any thread. Acts leave it in the order in which they came."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lock = Lock()
        self._start = 0  # what is before it is in the database

    def append(self, acts: Iterable[Act]) -> None:
        """Keep some acts, on the disk itself: all of them or none. Raises `OSError`."""
        lines = b"".join(_line(act) for act in acts)
        with self._lock, self.path.open("a+b", buffering=0) as file:
            size = file.seek(0, os.SEEK_END)
            if _is_torn(file, size):
                lines = b"\n" + lines
            try:
                if file.write(lines) != len(lines):
                    raise OSError(f"{self.path} took only some of what is to be kept")
                os.fsync(file.fileno())
            except OSError:
                file.truncate(size)
                raise

    def oldest(self, most: int) -> Batch:
        """The oldest acts, in order. Raises `OSError`."""
        acts: list[Act] = []
        end = self._start
        if not self.path.exists():
            return Batch(acts, end)
        with self._lock, self.path.open("rb") as file:
            file.seek(self._start)
            while len(acts) < most and (line := file.readline()):
                end = file.tell()
                acts += _read(line)
        return Batch(acts, end)

    def drop(self, end: int) -> None:
        """What is before `end` is in the database. Raises `OSError`."""
        with self._lock:
            self._start = end
            if self.path.exists() and self.path.stat().st_size <= end:
                os.truncate(self.path, 0)
                self._start = 0


def _is_torn(file: IO[bytes], size: int) -> bool:
    """A kill may have come in the middle of a line: the next one begins on its own."""
    if size == 0:
        return False
    file.seek(size - 1)
    return file.read(1) != b"\n"


def _line(act: Act) -> bytes:
    return json.dumps(asdict(act)).encode() + b"\n"


def _read(line: bytes) -> list[Act]:
    """The act of a line; none where it is torn."""
    try:
        return [Act(**json.loads(line))]
    except (ValueError, TypeError):
        _log.warning("audit: a line of the spool cannot be read: %r", line[:200])
        return []
