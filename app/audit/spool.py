"""A file of acts that are not in the database yet, a line each: what is in it survives the console."""

import json
import logging
import os
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from threading import Lock
from typing import NamedTuple

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
        self._end_torn_line()

    def append(self, acts: Iterable[Act]) -> None:
        """Keep some acts, on the disk itself: all of them or none. Raises `OSError`."""
        lines = b"".join(_line(act) for act in acts)
        with self._lock, self.path.open("ab", buffering=0) as file:
            size = file.tell()
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

    def _end_torn_line(self) -> None:
        """A kill may have come in the middle of a line: the next one begins on its own."""
        if not self.path.exists() or self.path.stat().st_size == 0:
            return
        with self.path.open("r+b") as file:
            file.seek(-1, os.SEEK_END)
            if file.read(1) != b"\n":
                file.write(b"\n")


def _line(act: Act) -> bytes:
    return json.dumps(asdict(act)).encode() + b"\n"


def _read(line: bytes) -> list[Act]:
    """The act of a line; none where it is torn."""
    try:
        return [Act(**json.loads(line))]
    except (ValueError, TypeError):
        _log.warning("audit: a line of the spool cannot be read: %r", line[:200])
        return []
