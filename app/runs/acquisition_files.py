"""The tables of a run's acquisitions: a Parquet file each, which appears whole or not at all."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from app.analysis.acquisition.table import Column, Rows
from app.recording.whole_file import whole_file

BATCH_ROWS = 16_384


def acquisition_path(folder: Path, index: int) -> Path:
    """The file of an acquisition, by its place in the test."""
    return folder / f"acquisition-{index}.parquet"


class AcquisitionWriter:
    """Appends rows to a table that is being made."""

    def __init__(self, columns: Sequence[Column], writer: pq.ParquetWriter) -> None:
        self._schema = _schema(columns)
        self._writer = writer
        self._waiting: list[Rows] = []
        self._rows = 0

    def append(self, rows: Rows) -> None:
        """Append rows of the table's columns."""
        count = len(next(iter(rows.values())))
        if count:
            self._waiting.append(rows)
            self._rows += count
        if self._rows >= BATCH_ROWS:
            self.flush()

    def flush(self) -> None:
        """Write what waits for more."""
        if self._rows:
            pieces = self._waiting
            arrays = [np.concatenate([p[name] for p in pieces]) for name in self._schema.names]
            self._writer.write_table(pa.Table.from_arrays(arrays, schema=self._schema))
        self._waiting, self._rows = [], 0


@contextmanager
def writing(path: Path, columns: Sequence[Column]) -> Iterator[AcquisitionWriter]:
    """A table of `columns` at `path`: there when all went well, and not at all otherwise.

    Raises `OSError`.
    """
    with (
        whole_file(path) as file,
        pq.ParquetWriter(file, _schema(columns), compression="zstd") as writer,
    ):
        table = AcquisitionWriter(columns, writer)
        yield table
        table.flush()


def read_rows(path: Path) -> Iterator[Rows]:
    """The rows of a table, some at a time."""
    with pq.ParquetFile(path) as file:
        for batch in file.iter_batches(BATCH_ROWS):
            yield {name: batch.column(name).to_numpy() for name in batch.schema.names}


def count_rows(path: Path) -> int:
    """How many rows a table has."""
    return int(pq.read_metadata(path).num_rows)


def _schema(columns: Sequence[Column]) -> pa.Schema:
    return pa.schema(
        [
            pa.field(c.name, pa.from_numpy_dtype(np.dtype(c.dtype)), False, {"unit": c.unit})
            for c in columns
        ]
    )
