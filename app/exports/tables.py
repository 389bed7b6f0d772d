"""Parquet and CSV."""

import json
from collections.abc import Iterator, Mapping
from typing import Any, BinaryIO

import numpy as np
import pyarrow as pa
import pyarrow.csv as pa_csv
import pyarrow.parquet as pq

from app.exports.extract import Extract, Progress, dtype_of
from app.exports.told import facts, unit
from app.recording.parquet import METADATA_KEY
from rtcore.channels import CHANNEL

_DELTAS = frozenset({"tick", "cycle", "deadlines_missed"})


def write_parquet(out: BinaryIO, wanted: Extract, progress: Progress) -> None:
    """As it was recorded, with units in the fields' metadata."""
    schema = _schema(wanted)
    encoding = {
        f.name: "DELTA_BINARY_PACKED" if f.name in _DELTAS else "BYTE_STREAM_SPLIT" for f in schema
    }
    how: Mapping[str, Any] = {
        "compression": "zstd",
        "compression_level": 1,
        "use_dictionary": False,
        "column_encoding": encoding,
    }
    with pq.ParquetWriter(out, schema, **how) as writer:
        for batch in _batches(wanted, schema, progress):
            writer.write_batch(batch)
        text = json.dumps(dict(wanted.description), sort_keys=True)
        writer.add_key_value_metadata({METADATA_KEY: text.encode()})


def write_csv(out: BinaryIO, wanted: Extract, progress: Progress) -> None:
    """Lines that begin with # say what it is, the next one names channels with their units.

    Each figure has as many digits as bring back the recorded one, and no more.
    """
    for name, value in facts(wanted.description).items():
        shown = " ".join(str(value).split())
        out.write(f"# {name}: {shown}\n".encode())
    out.write(",".join(f"{name} [{unit(name)}]" for name in wanted.names).encode() + b"\n")
    schema = _schema(wanted)
    plain = pa_csv.WriteOptions(include_header=False, quoting_style="none")
    with pa_csv.CSVWriter(out, schema, write_options=plain) as writer:
        for batch in _batches(wanted, schema, progress):
            writer.write_batch(batch)


def _schema(wanted: Extract) -> Any:
    return pa.schema(
        pa.field(
            name,
            pa.from_numpy_dtype(dtype_of(name)),
            nullable=False,
            metadata={"unit": unit(name), "description": CHANNEL[name].doc},
        )
        for name in wanted.names
    )


def _batches(wanted: Extract, schema: Any, progress: Progress) -> Iterator[Any]:
    for chunk in wanted.chunks(progress):
        columns = [pa.array(np.ascontiguousarray(chunk[name])) for name in wanted.names]
        yield pa.RecordBatch.from_arrays(columns, schema=schema)
