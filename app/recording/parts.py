"""The parts of a recording under way: Arrow IPC streams, one for each life of the recorder.

Each batch carries a checksum and is whole or not there: what a kill or a full disk left of the last
one is cut when the part is read.
"""

import os
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from app.recording.columns import SCHEMA, as_batch

_CHECKSUM = b"crc32"


def part_paths(folder: Path) -> list[Path]:
    """The parts in a run's folder, in the order in which they were written."""
    return sorted(folder.glob("part-*.arrows"))


def _checksum(batch: Any) -> bytes:
    sums = 0
    for column in batch.columns:
        sums = zlib.crc32(column.to_numpy(), sums)
    return b"%08x" % sums


class PartWriter:
    """Appends records to a new part in a run's folder."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        number = 1 + max((int(p.stem.removeprefix("part-")) for p in part_paths(folder)), default=0)
        self.path = folder / f"part-{number:04}.arrows"
        # Unbuffered: what `append` returned from is in the system's hands and survives a kill.
        self._file = self.path.open("xb", buffering=0)
        try:
            self._stream = pa.ipc.new_stream(self._file, SCHEMA)
        except BaseException:
            self._file.close()
            raise

    def append(self, records: npt.NDArray[Any]) -> None:
        """Append (n,) TELEMETRY as one batch. After an `OSError` this part is done for."""
        batch = as_batch(records)
        self._stream.write_batch(batch, custom_metadata={_CHECKSUM: _checksum(batch)})

    @property
    def size_bytes(self) -> int:
        return os.fstat(self._file.fileno()).st_size

    def sync(self) -> None:
        """Bring what was appended to the disk itself. For another thread: it may take seconds."""
        handle = os.dup(self._file.fileno())
        try:
            os.fsync(handle)
        finally:
            os.close(handle)

    def close(self) -> None:
        """End the stream. The part is readable without this too."""
        try:
            self._stream.close()
        finally:
            self._file.close()


def read_part(path: Path, *, verify: bool = True) -> Iterator[Any]:
    """The whole record batches of a part, mapped, not read; ends where the part does or is torn.

    Without `verify` only what is torn is noticed, not what is wrong: quick, as for a chart.
    """
    try:
        source = pa.memory_map(str(path))
        stream = pa.ipc.open_stream(source)
    except (pa.ArrowException, OSError):
        return
    if not stream.schema.equals(SCHEMA):
        return
    while True:
        try:
            batch, metadata = stream.read_next_batch_with_custom_metadata()
            batch.validate()
        except (StopIteration, pa.ArrowException, OSError):
            return
        if verify and (metadata is None or metadata.get(_CHECKSUM) != _checksum(batch)):
            return
        yield batch


def read_parts(folder: Path, *, verify: bool = True) -> Iterator[Any]:
    """The batches of all parts in order, each tick once.

    A part may repeat what the one before it has, where a write failed after all had been written.
    """
    last = -1
    for path in part_paths(folder):
        for batch in read_part(path, verify=verify):
            ticks = batch.column("tick").to_numpy()
            fresh = batch.slice(int(np.searchsorted(ticks, last, side="right")))
            if fresh.num_rows:
                last = int(ticks[-1])
                yield fresh


@dataclass(frozen=True)
class Extent:
    """Which ticks of a run are recorded; the first and last are -1 where there are none."""

    first_tick: int = -1
    last_tick: int = -1
    ticks: int = 0

    def grown_by(self, ticks: npt.NDArray[Any]) -> "Extent":
        """With these ascending ticks after it."""
        first = int(ticks[0]) if self.ticks == 0 else self.first_tick
        return Extent(first, int(ticks[-1]), self.ticks + len(ticks))


def extent_of(folder: Path) -> Extent:
    """What is whole on disk of a recording under way."""
    extent = Extent()
    for batch in read_parts(folder):
        extent = extent.grown_by(batch.column("tick").to_numpy())
    return extent
