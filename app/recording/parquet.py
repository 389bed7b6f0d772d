"""The file of a run that is over: Parquet, in place in one step or not at all."""

import json
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from app.recording.columns import SCHEMA

METADATA_KEY = b"forcerig"
ROW_GROUP = 65_536


def write_run(path: Path, batches: Iterable[Any], metadata: Mapping[str, Any]) -> None:
    """Write record batches of `SCHEMA`, in order, as one Parquet file at `path`.

    `metadata` is kept in the file as JSON: what the run was, and with which settings. The file
    appears under its name when it is whole and on the disk. Raises `OSError`.
    """
    described = {METADATA_KEY: json.dumps(metadata, allow_nan=False, sort_keys=True).encode()}
    schema = SCHEMA.with_metadata(described)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            with pq.ParquetWriter(file, schema, compression="zstd") as writer:
                for table in _row_groups(batches):
                    writer.write_table(table.replace_schema_metadata(described), ROW_GROUP)
            file.flush()
            os.fchmod(file.fileno(), 0o644)
            os.fsync(file.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    _sync_folder(path.parent)


def read_metadata(path: Path) -> dict[str, Any]:
    """What `write_run` was told of the run."""
    described: dict[str, Any] = json.loads(pq.read_schema(path).metadata[METADATA_KEY])
    return described


def _row_groups(batches: Iterable[Any]) -> Iterator[Any]:
    """The batches as tables of `ROW_GROUP` rows; the last one has what remains."""
    waiting: list[Any] = []
    rows = 0
    for batch in batches:
        waiting.append(batch)
        rows += batch.num_rows
        while rows >= ROW_GROUP:
            table = pa.Table.from_batches(waiting, SCHEMA)
            yield table.slice(0, ROW_GROUP)
            waiting = table.slice(ROW_GROUP).to_batches()
            rows -= ROW_GROUP
    if rows:
        yield pa.Table.from_batches(waiting, SCHEMA)


def _sync_folder(folder: Path) -> None:
    """Bring a new name to the disk itself."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
