"""A backup of a data directory, made while the console runs: one archive, whole under its name or not there.

The database comes first, as it is at one moment. Of the runs that it knows, those that are over come
with their file; of one under way, what its parts held when they were read. What is torn at the end of
such a part is cut when the run is filed after a restore. Black boxes of first-outs and samples of drills
come after it: one that is younger than the database is entered again, or left alone, after a restore.
"""

import io
import json
import sqlite3
import tarfile
import tempfile
from collections.abc import Callable, Iterable
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import IO, Any

import pyarrow as pa

from app.audit.head import HEAD_FILE
from app.audit.spool import SPOOL_FILE
from app.recording.whole_file import PREFIX, whole_file
from app.settings import VERSION
from app.storage.space import bytes_of

DATABASE = "forcerig.sqlite"
MANIFEST = "backup.json"
FORMAT = 1
Progress = Callable[[float], None]

_OVER = ("run.parquet", "overview-*.bin")
_UNDER_WAY = ("part-*.arrows", "stopped-because.txt")
_SMALL = (
    "acquisition-*.parquet",
    "predicted.parquet",
    "analysis.json",
    "frequency-response.json",
    "*.damaged",
)
_ATTEMPTS = 10  # a run may end while its files are being opened


@dataclass(frozen=True)
class Source:
    """What is backed up. `database` is None where it is on a server."""

    data_dir: Path
    database: Path | None
    with_samples: bool = True


@dataclass(frozen=True)
class Made:
    """What is in a backup."""

    runs: int
    under_way: int
    files: int
    bytes: int


def back_up(source: Source, target: Path, progress: Progress = lambda share: None) -> Made:
    """Write the archive; compressed where its name ends in `.zst`. Raises `OSError`, `sqlite3.Error`."""
    with whole_file(target) as file, ExitStack() as stack:
        out: IO[bytes] = file
        if target.suffix == ".zst":  # samples are compressed already: this is for the database
            out = stack.enter_context(pa.CompressedOutputStream(_Kept(file), "zstd"))
        archive = stack.enter_context(tarfile.open(fileobj=out, mode="w|"))
        audit = _of_the_audit(source.data_dir)
        with tempfile.TemporaryDirectory(dir=target.parent, prefix=PREFIX) as folder:
            runs = _database(source, archive, Path(folder))
        for name, content in audit.items():
            _add_bytes(archive, name, content)
        made = _Made(archive)
        folders = [source.data_dir / "runs" / str(run_id) for run_id in runs]
        sizes = [bytes_of(folder) for folder in folders]
        whole, done = max(1, sum(sizes)), 0
        for run, size in zip(folders, sizes, strict=True) if source.with_samples else ():
            made.run(run)
            done += size
            progress(done / whole)
        made.folder(source.data_dir, "histories")
        if source.with_samples:
            made.folder(source.data_dir, "drills")
            made.folder(source.data_dir, "first-outs")
            for box in sorted((source.data_dir / "first-outs").glob("[0-9]*")):
                made.folder(source.data_dir, f"first-outs/{box.name}")
        progress(1.0)
    return Made(len(runs), made.under_way, made.files, target.stat().st_size)


class _Made:
    """Puts files into an archive, and counts them."""

    def __init__(self, archive: tarfile.TarFile) -> None:
        self._archive = archive
        self.under_way = self.files = 0

    def run(self, folder: Path) -> None:
        """The files of a run. They are all open before the first is read: what is removed then stays."""
        for attempt in range(_ATTEMPTS):
            over = (folder / "run.parquet").exists()
            paths = _found(folder, (*(_OVER if over else _UNDER_WAY), *_SMALL))
            with ExitStack() as stack:
                try:
                    opened = [(path, stack.enter_context(path.open("rb"))) for path in paths]
                except FileNotFoundError:
                    if attempt == _ATTEMPTS - 1:
                        raise
                    continue
                if not over and (folder / "run.parquet").exists():
                    continue  # it has ended meanwhile
                self.under_way += not over and bool(paths)
                for path, file in opened:
                    self._add(f"runs/{folder.name}/{path.name}", path, file)
                return

    def folder(self, data_dir: Path, name: str) -> None:
        """Every file of a folder; not those in the writing, nor those removed meanwhile."""
        for path in sorted((data_dir / name).glob("*")):
            if path.name.startswith(PREFIX) or not path.is_file():
                continue
            with suppress(FileNotFoundError), path.open("rb") as file:
                self._add(f"{name}/{path.name}", path, file)

    def _add(self, name: str, path: Path, file: IO[bytes]) -> None:
        self._archive.addfile(self._archive.gettarinfo(arcname=name, fileobj=file), file)
        self.files += 1


def _found(folder: Path, patterns: Iterable[str]) -> list[Path]:
    return [path for pattern in patterns for path in sorted(folder.glob(pattern))]


def _of_the_audit(data_dir: Path) -> dict[str, bytes]:
    """The end of its chain, which may lag behind the database and not be ahead, and what waits for it.

    So both are read before the database is.
    """
    paths = [data_dir / name for name in (SPOOL_FILE, HEAD_FILE)]
    return {path.name: path.read_bytes() for path in paths if path.exists()}


def _database(source: Source, archive: tarfile.TarFile, folder: Path) -> list[int]:
    """Put the database in, as it is now, with what the archive is; the runs that it knows."""
    runs_dir = source.data_dir / "runs"
    copy = folder / DATABASE
    if source.database is not None:
        snapshot(source.database, copy)
        runs = known_runs(copy)
    else:
        runs = sorted(int(path.name) for path in runs_dir.glob("*") if path.name.isdecimal())
    told = {
        "format": FORMAT,
        "version": VERSION,
        "made_at": datetime.now(UTC).isoformat(),
        "database": "sqlite" if source.database is not None else "elsewhere",
        "with_samples": source.with_samples,
        "runs": len(runs),
    }
    _add_text(archive, MANIFEST, told)
    if source.database is not None:
        archive.add(copy, DATABASE)
    return runs


def snapshot(database: Path, copy: Path) -> None:
    """A copy of a database that is in use, as it is at one moment. Raises `sqlite3.Error`."""
    with (
        closing(sqlite3.connect(f"{database.resolve().as_uri()}?mode=rw", uri=True)) as live,
        closing(sqlite3.connect(copy)) as kept,
    ):
        live.backup(kept)
        kept.execute("PRAGMA journal_mode=DELETE")  # one file, nothing beside it
        (found,) = kept.execute("PRAGMA integrity_check").fetchone()
        if found != "ok":
            raise sqlite3.DatabaseError(f"the database is damaged: {found}")


def known_runs(database: Path) -> list[int]:
    """The runs in the book. Raises `sqlite3.Error`."""
    with closing(sqlite3.connect(database)) as connection:
        return [int(run_id) for (run_id,) in connection.execute("SELECT id FROM runs ORDER BY id")]


def _add_text(archive: tarfile.TarFile, name: str, told: dict[str, Any]) -> None:
    _add_bytes(archive, name, json.dumps(told, indent=2).encode())


def _add_bytes(archive: tarfile.TarFile, name: str, content: bytes) -> None:
    member = tarfile.TarInfo(name)
    member.size, member.mode = len(content), 0o644
    member.mtime = int(datetime.now(UTC).timestamp())
    archive.addfile(member, io.BytesIO(content))


class _Kept:
    """A file that whoever writes through it does not close."""

    closed = False

    def __init__(self, file: IO[bytes]) -> None:
        self.write, self.flush = file.write, file.flush

    def close(self) -> None: ...
