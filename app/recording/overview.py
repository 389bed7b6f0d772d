"""The overview of a run: its bins of every width in files of rows, mapped when read.

Derived data. A file says of which layout and of which ticks it is; one that is missing, torn or
of something else counts as not there, and is made again from the samples.
"""

import hashlib
import os
import zlib
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from app.recording.bins import ROW, WIDTHS, Columns, Pyramid, Rows
from app.recording.extent import Extent
from app.recording.whole_file import whole_file

LAYOUT = hashlib.sha256(f"1 {WIDTHS} {ROW.descr}".encode()).digest()[:8]
HEADER = np.dtype(
    [("layout", "S8"), ("first_tick", "i8"), ("last_tick", "i8"), ("ticks", "i8"), ("crc32", "i8")]
)


@dataclass(frozen=True)
class Level:
    """Bins of one width; `to_tick` is the first tick that they do not tell of."""

    width: int
    rows: Rows
    to_tick: int


def overview_path(folder: Path, level: int) -> Path:
    """The bins of one width of a run that is over."""
    return folder / f"overview-{level}.bin"


def write_overview(folder: Path, chunks: Iterable[Columns]) -> Iterator[Columns]:
    """Pass the columns of a run on, in order; its overview is in place when they are through.

    Raises `OSError`.
    """
    pyramid, extent, sums = Pyramid(), Extent(), [0] * len(WIDTHS)
    with ExitStack() as stack:
        paths = [overview_path(folder, i) for i in range(len(WIDTHS))]
        files = [stack.enter_context(whole_file(path)) for path in paths]
        for file in files:
            file.write(bytes(HEADER.itemsize))
        for columns in chunks:
            extent = extent.grown_by(columns["tick"])
            _append(files, pyramid.add(columns), sums)
            yield columns
        _append(files, pyramid.finish(), sums)
        for file, crc32 in zip(files, sums, strict=True):
            file.seek(0)
            file.write(_header(extent, crc32))


def read_overview(folder: Path, extent: Extent) -> tuple[Level, ...] | None:
    """The overview of a run of which these ticks are recorded; None where there is none of it."""
    levels = [_level(folder, i, extent) for i in range(len(WIDTHS))]
    found = tuple(level for level in levels if level is not None)
    return found if len(found) == len(WIDTHS) else None


def rows_in(path: Path, offset: int = 0) -> Rows:
    """The whole rows of a file behind `offset`, mapped. Raises `OSError`."""
    count = (path.stat().st_size - offset) // ROW.itemsize
    if count <= 0:
        return np.empty(0, ROW)
    return np.memmap(path, ROW, "r", offset, (count,))


def _append(files: list[BinaryIO], found: list[Rows], sums: list[int]) -> None:
    for i, (file, rows) in enumerate(zip(files, found, strict=True)):
        content = rows.tobytes()
        sums[i] = zlib.crc32(content, sums[i])
        file.write(content)


def _header(extent: Extent, crc32: int) -> bytes:
    row = (LAYOUT, extent.first_tick, extent.last_tick, extent.ticks, crc32)
    return np.array([row], HEADER).tobytes()


def _level(folder: Path, level: int, extent: Extent) -> Level | None:
    path = overview_path(folder, level)
    try:
        with path.open("rb") as file:
            content = file.read(HEADER.itemsize)
            rest = os.fstat(file.fileno()).st_size - HEADER.itemsize
        rows = rows_in(path, HEADER.itemsize)
    except (OSError, ValueError):
        return None
    if rest % ROW.itemsize or content != _header(extent, zlib.crc32(rows.view(np.uint8).data)):
        return None
    return Level(WIDTHS[level], rows, extent.last_tick + 1)
