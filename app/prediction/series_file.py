"""The force and displacement that were predicted for a run, in its folder: `predicted.parquet`."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from app.prediction.through import Series
from app.recording.whole_file import whole_file

NAME = "predicted.parquet"
SCHEMA = pa.schema(
    [
        pa.field("program_tick", pa.int64(), nullable=False),
        pa.field("force_n", pa.float32(), nullable=False),
        pa.field("displacement_m", pa.float32(), nullable=False),
    ]
)
_ENCODING = {
    "program_tick": "DELTA_BINARY_PACKED",
    "force_n": "BYTE_STREAM_SPLIT",
    "displacement_m": "BYTE_STREAM_SPLIT",
}
ROW_GROUP = 65_536


def write_series(folder: Path, series: Series, ticks: int) -> None:
    """Write the first `ticks` of the program into a run's folder, which is made where it is not there.

    Raises `OSError`.
    """
    columns = [
        pa.array(np.arange(ticks, dtype=np.int64)),
        pa.array(series.force_n[:ticks]),
        pa.array(series.displacement_m[:ticks]),
    ]
    folder.mkdir(parents=True, exist_ok=True)
    with whole_file(folder / NAME) as file:
        pq.write_table(
            pa.Table.from_arrays(columns, schema=SCHEMA),
            file,
            row_group_size=ROW_GROUP,
            compression="zstd",
            compression_level=1,
            use_dictionary=False,
            column_encoding=_ENCODING,
        )


def remove_series(folder: Path) -> None:
    """Remove it again, and the folder where nothing else is in it."""
    (folder / NAME).unlink(missing_ok=True)
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
