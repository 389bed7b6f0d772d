"""The columns of a recording, derived from the telemetry channels."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from rtcore.channels import CHANNEL, CHANNELS, TELEMETRY

SCHEMA = pa.schema(
    [pa.field(c.name, pa.from_numpy_dtype(np.dtype(c.dtype)), nullable=False) for c in CHANNELS]
)


def not_recorded(name: str, ticks: int) -> npt.NDArray[Any]:
    """(ticks,) of a channel that a recording of before it was there lacks: NaN, or −1 where it counts."""
    dtype = np.dtype(CHANNEL[name].dtype)
    return np.full(ticks, np.nan if dtype.kind == "f" else -1, dtype)


def whole_columns(table: Any) -> dict[str, npt.NDArray[Any]]:
    """Every channel of an Arrow table of telemetry, whenever it was recorded."""
    there = set(table.column_names)
    return {
        c.name: table[c.name].to_numpy() if c.name in there else not_recorded(c.name, len(table))
        for c in CHANNELS
    }


def as_batch(records: npt.NDArray[Any]) -> Any:
    """(n,) TELEMETRY as an Arrow record batch, a column a channel."""
    columns = [pa.array(np.ascontiguousarray(records[c.name])) for c in CHANNELS]
    return pa.RecordBatch.from_arrays(columns, schema=SCHEMA)


def as_records(batch: Any) -> npt.NDArray[Any]:
    """The opposite of `as_batch`."""
    records = np.zeros(batch.num_rows, TELEMETRY)
    for name in batch.schema.names:
        records[name] = batch.column(name).to_numpy()
    return records
