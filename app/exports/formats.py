"""The table of formats."""

from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import BinaryIO, NamedTuple

from app.errors import Refusal
from app.exports.extract import Extract, Progress
from app.exports.hdf5 import write_hdf5
from app.exports.matlab import why_not_mat, write_mat
from app.exports.tables import write_csv, write_parquet
from app.exports.tdms import write_tdms
from rtcore.channels import CHANNELS


class FormatName(StrEnum):
    """Each is the ending of the file's name."""

    PARQUET = "parquet"
    CSV = "csv"
    MAT = "mat"
    TDMS = "tdms"
    HDF5 = "h5"


class Format(NamedTuple):
    """How a recording is written in it.

    `stream` writes from beginning to end; what has none goes back in its file: `whole` writes that.
    `bytes_per_tick` is what all channels take at most, for the room that must be free.
    """

    title: str
    media_type: str
    bytes_per_tick: int
    stream: Callable[[BinaryIO, Extract, Progress], None] | None = None
    whole: Callable[[Path, Extract, Progress], None] | None = None
    why_not: Callable[[Extract], Refusal | None] = lambda wanted: None

    def bytes_needed(self, wanted: Extract) -> int:
        """What the file takes at most."""
        share = len(wanted.names) / len(CHANNELS)
        return 1_000_000 + round(wanted.ticks * self.bytes_per_tick * max(share, 0.1))


FORMATS = {
    FormatName.PARQUET: Format(
        "Parquet", "application/vnd.apache.parquet", 60, stream=write_parquet
    ),
    FormatName.CSV: Format("CSV", "text/csv; charset=utf-8", 320, stream=write_csv),
    FormatName.MAT: Format(
        "MATLAB", "application/x-matlab-data", 112, stream=write_mat, why_not=why_not_mat
    ),
    FormatName.TDMS: Format("TDMS", "application/x-tdms", 112, stream=write_tdms),
    FormatName.HDF5: Format("HDF5", "application/x-hdf5", 80, whole=write_hdf5),
}


def write(path: Path, name: FormatName, wanted: Extract, progress: Progress) -> None:
    """Write the file at `path`. Raises `OSError`."""
    form = FORMATS[name]
    if form.whole is not None:
        form.whole(path, wanted, progress)
    else:
        assert form.stream is not None
        with path.open("wb") as out:
            form.stream(out, wanted, progress)


def by_suffix(path: Path) -> FormatName | None:
    """The format that the name of a file asks for."""
    suffix = path.suffix.lower().removeprefix(".")
    return next((name for name in FormatName if name.value == suffix), None)
