"""A recording, and what others read from the files that are made of it: by their own libraries."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.csv as pa_csv
import pyarrow.parquet as pq
import scipy.io
from nptdms import TdmsFile

from app.exports.formats import FormatName
from app.recording.columns import as_batch
from app.recording.parquet import write_run
from rtcore.channels import CHANNELS, TELEMETRY

Columns = Mapping[str, npt.NDArray[Any]]
PERIOD_S = 2.5e-4
DESCRIPTION = {
    "test_name": "A test with an umlaut: Prüfung",
    "period_ns": 250_000,
    "first_tick": 1000,
    "outcome": "completed",
    "definition": {"name": "Prüfung", "blocks": [{"kind": "hold", "duration_s": 1.0}] * 2000},
    "reason": None,
}


def records(ticks: int, missing: tuple[int, int] | None = None) -> npt.NDArray[Any]:
    """(n,) TELEMETRY of any bits: also what is not a number, and integers at their limits."""
    random = np.random.default_rng(7)
    made = np.zeros(ticks, TELEMETRY)
    for channel in CHANNELS:
        dtype = np.dtype(channel.dtype)
        if dtype.kind == "f":
            made[channel.name] = random.normal(0.0, 1e3, ticks)
            made[channel.name][::97] = np.nan
        else:
            info = np.iinfo(dtype)
            made[channel.name] = random.integers(info.min, info.max, ticks, dtype, endpoint=True)
    made["tick"] = np.arange(1000, 1000 + ticks)
    if missing is not None:
        made = np.delete(made, slice(*missing))
    return made


def recorded(path: Path, made: npt.NDArray[Any]) -> Path:
    """The file of a run with these ticks."""
    batches = (as_batch(made[at : at + 40_000]) for at in range(0, len(made), 40_000))
    write_run(path, batches, DESCRIPTION)
    return path


def _parquet(path: Path) -> Columns:
    table = pq.read_table(path)
    return {name: table[name].to_numpy() for name in table.column_names}


def _csv(path: Path) -> Columns:
    lines = path.read_text().splitlines()
    comments = sum(line.startswith("#") for line in lines)
    names = [cell.split(" [")[0] for cell in lines[comments].split(",")]
    read = pa_csv.ReadOptions(skip_rows=comments + 1, column_names=names)
    types = {c.name: pa.from_numpy_dtype(np.dtype(c.dtype)) for c in CHANNELS}
    table = pa_csv.read_csv(path, read, convert_options=pa_csv.ConvertOptions(column_types=types))
    return {name: table[name].to_numpy() for name in names}


def _mat(path: Path) -> Columns:
    found = scipy.io.loadmat(path)
    known = {channel.name for channel in CHANNELS}
    return {name: values[:, 0] for name, values in found.items() if name in known}


def _tdms(path: Path) -> Columns:
    return {c.name: c[:] for c in TdmsFile.read(path)["recording"].channels()}


def _hdf5(path: Path) -> Columns:
    with h5py.File(path) as file:
        return {name: file[name][:] for name in file if isinstance(file[name], h5py.Dataset)}


READ: Mapping[FormatName, Callable[[Path], Columns]] = {
    FormatName.PARQUET: _parquet,
    FormatName.CSV: _csv,
    FormatName.MAT: _mat,
    FormatName.TDMS: _tdms,
    FormatName.HDF5: _hdf5,
}
