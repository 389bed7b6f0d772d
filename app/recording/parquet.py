"""The file of a run that is over: Parquet, in place in one step or not at all."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from app.recording.columns import SCHEMA
from app.recording.whole_file import whole_file

METADATA_KEY = b"forcerig"
ROW_GROUP = 65_536
# Measured in docs/decisions/0011: 28 bytes a tick instead of 46, in a third of the time.
_PACKED = ("tick", "program_tick", "cycle", "deadlines_missed")
_REPEATED = ("trips", "run", "block", "mode")
_ENCODING = {
    "compression": "zstd",
    "compression_level": 1,
    "use_dictionary": list(_REPEATED),
    "column_encoding": {
        f.name: "DELTA_BINARY_PACKED" if f.name in _PACKED else "BYTE_STREAM_SPLIT"
        for f in SCHEMA
        if f.name not in _REPEATED
    },
}


def write_run(
    path: Path,
    batches: Iterable[Any],
    metadata: Mapping[str, Any] | Callable[[], Mapping[str, Any]],
) -> None:
    """Write record batches of `SCHEMA`, in order, as one Parquet file at `path`.

    `metadata` is kept in the file as JSON: what the run was, and with which settings; a function is
    asked for it after the last batch. The file appears under its name when it is whole and on the
    disk. Raises `OSError`.
    """
    with whole_file(path) as file, pq.ParquetWriter(file, SCHEMA, **_ENCODING) as writer:
        for table in row_groups(batches):
            writer.write_table(table, ROW_GROUP)
        described = metadata() if callable(metadata) else metadata
        text = json.dumps(described, allow_nan=False, sort_keys=True)
        writer.add_key_value_metadata({METADATA_KEY: text.encode()})


def read_metadata(path: Path) -> dict[str, Any]:
    """What `write_run` was told of the run."""
    described: dict[str, Any] = json.loads(pq.read_metadata(path).metadata[METADATA_KEY])
    return described


def row_groups(batches: Iterable[Any]) -> Iterator[Any]:
    """The batches as tables of `ROW_GROUP` rows in one piece; the last one has what remains."""
    waiting: list[Any] = []
    rows = 0
    for batch in batches:
        waiting.append(batch)
        rows += batch.num_rows
        while rows >= ROW_GROUP:
            table = pa.Table.from_batches(waiting)
            yield table.slice(0, ROW_GROUP).combine_chunks()
            waiting = table.slice(ROW_GROUP).to_batches()
            rows -= ROW_GROUP
    if rows:
        yield pa.Table.from_batches(waiting).combine_chunks()
