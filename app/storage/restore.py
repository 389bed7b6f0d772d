"""Putting a backup back: into a directory of its own, whole or not at all."""

import json
import re
import shutil
import sqlite3
import tarfile
import tempfile
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import pyarrow as pa

from app.audit.head import HEAD_FILE
from app.audit.spool import SPOOL_FILE
from app.storage.backup import DATABASE, FORMAT, MANIFEST, known_runs, snapshot

_ZSTD = b"\x28\xb5\x2f\xfd"
_AUDIT = "|".join(re.escape(name) for name in (HEAD_FILE, SPOOL_FILE))
_FILES = r"histories/[^/]+|drills/[^/]+|first-outs/(\d+/)?[^/]+|runs/\d+/[^/]+"
_MEMBER = re.compile(rf"(backup\.json|forcerig\.sqlite|{_AUDIT}|{_FILES})")
Progress = Callable[[float], None]


class NotABackup(Exception):
    """The archive cannot be put back; the message says why."""


@dataclass(frozen=True)
class Restored:
    """What was put back."""

    told: dict[str, Any]
    runs: int
    files: int


def restore(archive: Path, data_dir: Path, progress: Progress = lambda share: None) -> Restored:
    """Unpack into a directory that is empty or not there. Raises `NotABackup`, `OSError`."""
    if data_dir.exists() and (not data_dir.is_dir() or any(data_dir.iterdir())):
        raise NotABackup(f"{data_dir} is not empty: give a new directory")
    data_dir.parent.mkdir(parents=True, exist_ok=True)
    folder = Path(tempfile.mkdtemp(dir=data_dir.parent, prefix=f".{data_dir.name}."))
    try:
        files = _unpack(archive, folder, progress)
        told = _told(folder)
        runs = _checked(folder, told)
        (folder / MANIFEST).unlink()
        folder.chmod(0o755)
        if data_dir.exists():
            data_dir.rmdir()
        folder.rename(data_dir)
    except (tarfile.TarError, pa.ArrowException, EOFError) as error:
        raise NotABackup(f"{archive} is not a whole backup: {error}") from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return Restored(told, runs, files)


def _unpack(archive: Path, folder: Path, progress: Progress) -> int:
    files, size = 0, max(1, archive.stat().st_size)
    with ExitStack() as stack:
        file = stack.enter_context(archive.open("rb"))
        plain: IO[bytes] = file
        if file.read(4) == _ZSTD:
            plain = stack.enter_context(pa.CompressedInputStream(pa.OSFile(str(archive)), "zstd"))
        file.seek(0)
        members = stack.enter_context(tarfile.open(fileobj=plain, mode="r|"))
        for member in members:
            if not member.isfile() or _MEMBER.fullmatch(member.name) is None:
                raise NotABackup(f"{archive} holds {member.name!r}: it is no backup of a console")
            members.extract(member, folder, filter="data")
            files += 1
            progress(min(1.0, file.tell() / size))
    return files


def _told(folder: Path) -> dict[str, Any]:
    try:
        told: dict[str, Any] = json.loads((folder / MANIFEST).read_bytes())
    except (OSError, ValueError) as error:
        raise NotABackup("There is no account of what is in this archive") from error
    if told.get("format") != FORMAT:
        raise NotABackup(f"This backup is of format {told.get('format')}, only {FORMAT} is known")
    return told


def _checked(folder: Path, told: dict[str, Any]) -> int:
    """The number of runs in the book; it must be whole."""
    (folder / "runs").mkdir(exist_ok=True)
    if told["database"] != "sqlite":
        return int(told["runs"])
    try:
        snapshot(folder / DATABASE, folder / ".checked")  # reads and checks every page
        return len(known_runs(folder / DATABASE))
    except sqlite3.Error as error:
        raise NotABackup(f"The database in this backup is damaged: {error}") from error
    finally:
        (folder / ".checked").unlink(missing_ok=True)
