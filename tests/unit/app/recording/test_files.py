"""The file of a run: whole under its name, or not there; and read back in part."""

import errno
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from app.recording.columns import as_batch
from app.recording.files import parquet_path, remove_parts
from app.recording.parquet import ROW_GROUP, read_metadata, write_run
from app.recording.parts import PartWriter
from app.recording.samples import open_samples
from rtcore.channels import CHANNELS, TELEMETRY


def batches(count: int, first: int = 0, batch: int = 1000) -> Iterator[Any]:
    for start in range(first, first + count, batch):
        records = np.zeros(min(batch, first + count - start), TELEMETRY)
        records["tick"] = np.arange(start, start + len(records))
        records["force_n"] = records["tick"] % 1000
        yield as_batch(records)


def test_every_tick_every_channel_and_what_the_run_was(tmp_path: Path) -> None:
    path = tmp_path / "run.parquet"
    count = 2 * ROW_GROUP + 123
    write_run(path, batches(count), {"definition": {"name": "Stufe 2 kN"}, "reason": None})
    file = pq.ParquetFile(path)
    assert [file.metadata.row_group(i).num_rows for i in range(3)] == [ROW_GROUP, ROW_GROUP, 123]
    assert file.schema_arrow.names == [channel.name for channel in CHANNELS]
    assert {str(f.type) for f in file.schema_arrow} <= {
        *("int64", "uint64", "double", "float", "int32", "int16", "int8"),
    }
    assert np.array_equal(file.read(["tick"])["tick"].to_numpy(), np.arange(count))
    assert file.metadata.row_group(0).column(0).compression == "ZSTD"
    assert read_metadata(path) == {"definition": {"name": "Stufe 2 kN"}, "reason": None}


def test_a_failure_in_mid_write_leaves_nothing_behind(tmp_path: Path) -> None:
    def failing() -> Iterator[Any]:
        yield from batches(ROW_GROUP)
        raise OSError(errno.EIO, "Input/output error")

    with pytest.raises(OSError, match="Input/output"):
        write_run(tmp_path / "run.parquet", failing(), {})
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("over", [True, False])
def test_a_stretch_of_a_run_is_read_back(tmp_path: Path, *, over: bool) -> None:
    first, count = 500, 150_000
    if over:
        write_run(parquet_path(tmp_path), batches(count, first), {})
    else:
        part = PartWriter(tmp_path)
        for batch in batches(count, first):
            records = np.zeros(batch.num_rows, TELEMETRY)
            for name in ("tick", "force_n"):
                records[name] = batch.column(name).to_numpy()
            part.append(records)
        part.close()
    samples = open_samples(tmp_path)
    assert samples is not None
    assert (samples.first_tick, samples.last_tick) == (500, 150_499)
    chunks = list(samples.chunks(["force_n"], 65_000, 70_001))
    ticks = np.concatenate([chunk["tick"] for chunk in chunks])
    force_n = np.concatenate([chunk["force_n"] for chunk in chunks])
    assert np.array_equal(ticks, np.arange(65_000, 70_002))
    assert np.array_equal(force_n, ticks % 1000)


def test_a_run_without_samples_has_none(tmp_path: Path) -> None:
    assert open_samples(tmp_path) is None


def test_parts_go_and_the_file_stays(tmp_path: Path) -> None:
    PartWriter(tmp_path).close()
    write_run(parquet_path(tmp_path), batches(10), {})
    remove_parts(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["run.parquet"]


def test_a_recording_of_before_a_channel_was_there_is_read_with_it_unknown(tmp_path: Path) -> None:
    older = [batch.drop_columns(["program_tick"]) for batch in batches(5000)]
    pq.write_table(pa.Table.from_batches(older), parquet_path(tmp_path))
    samples = open_samples(tmp_path)
    assert samples is not None
    (chunk,) = samples.chunks(["force_n", "program_tick"], 100, 4000)
    assert set(chunk["program_tick"].tolist()) == {-1}
    assert chunk["force_n"][0] == 100.0
    finest = samples.levels()[0]
    assert finest.rows["high"]["program_tick"].max() == -1
    assert finest.rows["high"]["force_n"].max() == 999.0
