"""The parts of a recording under way: Arrow IPC streams, one for each life of the recorder.

Each batch carries a checksum and is whole or not there: what a kill or a full disk left of the last
one is cut when the part is read.
"""

import os
import zlib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from app.recording.columns import SCHEMA, as_batch
from app.recording.part_index import IndexWriter, entry_before

_CHECKSUM = b"crc32"
BEGINNING = -1  # before every tick


def part_paths(folder: Path) -> list[Path]:
    """The parts in a run's folder, in the order in which they were written."""
    return sorted(folder.glob("part-*.arrows"))


def _checksum(batch: Any) -> bytes:
    sums = 0
    for column in batch.columns:
        sums = zlib.crc32(column.to_numpy(), sums)
    return b"%08x" % sums


class _Sink:
    """Takes what Arrow writes; a batch goes to the file in one piece afterwards.

    Arrow does not look at how much an unbuffered file has taken: a disk that fills up in the middle
    of a write would go unnoticed.
    """

    closed = False

    def __init__(self) -> None:
        self._pieces: list[bytes] = []

    def write(self, data: Any) -> int:
        self._pieces.append(bytes(data))
        return len(data)

    def flush(self) -> None: ...

    def taken(self) -> bytes:
        """What has been written since the last call."""
        pieces, self._pieces = self._pieces, []
        return b"".join(pieces)


class PartWriter:
    """Appends records to a new part in a run's folder."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        number = 1 + max((int(p.stem.removeprefix("part-")) for p in part_paths(folder)), default=0)
        self.path = folder / f"part-{number:04}.arrows"
        # Unbuffered: what `append` returned from is in the system's hands and survives a kill.
        self._file = self.path.open("xb", buffering=0)
        self.size_bytes = 0
        try:
            self._index: IndexWriter | None = IndexWriter(self.path)
            self._sink = _Sink()
            self._stream = pa.ipc.new_stream(self._sink, SCHEMA)  # writes the schema with a batch
        except BaseException:
            self._file.close()
            raise

    def append(self, records: npt.NDArray[Any]) -> None:
        """Append (n,) TELEMETRY as one batch. After an `OSError` this part is done for."""
        batch = as_batch(records)
        offset = self.size_bytes
        self._stream.write_batch(batch, custom_metadata={_CHECKSUM: _checksum(batch)})
        self._write(self._sink.taken())
        if self._index is not None:
            try:
                self._index.add(offset, records["tick"])
            except OSError:  # the batch is written: a reader that begins further ahead finds it too
                self._close_index()

    def _write(self, content: bytes) -> None:
        rest = memoryview(content)
        while rest:
            written = os.write(self._file.fileno(), rest)
            self.size_bytes += written
            rest = rest[written:]

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
            self._write(self._sink.taken())
        finally:
            self._close_index()
            self._file.close()

    def _close_index(self) -> None:
        index, self._index = self._index, None
        if index is not None:
            with suppress(OSError):
                index.close()


def read_part(path: Path, *, verify: bool = True, offset: int = 0) -> Iterator[Any]:
    """The whole record batches of a part; ends where the part does or is torn.

    Without `verify` they are mapped, and only what is torn is noticed, not what is wrong: quick, as
    for a chart.
    `offset` is where a batch begins, as the part's index has it.
    """
    batches = _verified(path, offset) if verify else _as_they_are(path, offset)
    while True:
        try:
            batch = next(batches)
            batch.validate()
        except (StopIteration, pa.ArrowException, OSError, EOFError):
            return
        yield batch


def _as_they_are(path: Path, offset: int) -> Iterator[Any]:  # raises where the part ends
    source = pa.memory_map(str(path))
    if not pa.ipc.read_schema(pa.ipc.read_message(source)).equals(SCHEMA):
        return
    source.seek(max(offset, source.tell()))
    while True:
        yield pa.ipc.read_record_batch(pa.ipc.read_message(source), SCHEMA)


def _verified(path: Path, offset: int) -> Iterator[Any]:
    with pa.OSFile(str(path)) as file:  # read, not mapped: a day of it must not fill the memory
        source: Any = file
        if (
            offset
        ):  # only a stream hands out checksums: make one of the schema and what is asked for
            pa.ipc.read_message(file)
            head = file.tell()
            file.seek(0)
            schema = file.read(head)
            file.seek(max(offset, head))
            source = pa.BufferReader(schema + file.read())
        stream = pa.ipc.open_stream(source)
        while stream.schema.equals(SCHEMA):
            try:
                batch, metadata = stream.read_next_batch_with_custom_metadata()
            except StopIteration:
                return
            if metadata is None or metadata.get(_CHECKSUM) != _checksum(batch):
                return
            yield batch


def read_parts(folder: Path, *, verify: bool = True, from_tick: int = BEGINNING) -> Iterator[Any]:
    """The batches of all parts in order, each tick once; from the batch with `from_tick` on.

    A part may repeat what the one before it has, where a write failed after all had been written.
    """
    last = from_tick - 1
    for path in part_paths(folder):
        offset, _ = entry_before(path, from_tick)
        for batch in read_part(path, verify=verify, offset=offset):
            ticks = batch.column("tick").to_numpy()
            fresh = batch.slice(int(np.searchsorted(ticks, last, side="right")))
            if fresh.num_rows:
                last = int(ticks[-1])
                yield fresh
