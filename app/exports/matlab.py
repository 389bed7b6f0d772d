"""MAT files: a variable a channel, written column after column, so that no more than a chunk is in memory."""

import json
from typing import BinaryIO

import numpy as np

from app.errors import Code, Refusal
from app.exports.extract import Extract, Progress, dtype_of
from app.exports.mat_file import MOST_BYTES, column_header, file_header, padding, text, texts
from app.exports.told import facts, unit
from rtcore.channels import CHANNEL


def why_not_mat(wanted: Extract) -> Refusal | None:
    """Level 5 knows no variable of 2 GB."""
    widest = max(np.dtype(dtype_of(name)).itemsize for name in wanted.names)
    if wanted.ticks * widest + 1024 <= MOST_BYTES:
        return None
    most_s = MOST_BYTES // widest * wanted.period_s
    detail = (
        f"A MATLAB file holds at most {most_s / 3600:.0f} h of a channel, and "
        f"{wanted.ticks * wanted.period_s / 3600:.0f} h are wanted: choose a shorter window, or HDF5, "
        "which MATLAB reads with h5read"
    )
    return Refusal(Code.INVALID_REQUEST, detail)


def write_mat(out: BinaryIO, wanted: Extract, progress: Progress) -> None:
    """Channels under their names; `units` and `about` are structures, `run_json` has all settings."""
    rows = wanted.rows()
    out.write(file_header("a recording of forcerig"))
    out.write(texts("units", {name: unit(name) for name in wanted.names}))
    out.write(texts("descriptions", {name: CHANNEL[name].doc for name in wanted.names}))
    out.write(texts("about", {k: str(v) for k, v in facts(wanted.description).items()}))
    out.write(text("run_json", json.dumps(dict(wanted.description), sort_keys=True)))
    for done, name in enumerate(wanted.names):
        _write_column(out, wanted, name, rows)
        progress((done + 1) / len(wanted.names))


def _write_column(out: BinaryIO, wanted: Extract, name: str, rows: int) -> None:
    kind = np.dtype(dtype_of(name)).newbyteorder("<")
    out.write(column_header(name, kind, rows))
    chunks = wanted.chunks(lambda share: None, [name])
    out.writelines(np.ascontiguousarray(chunk[name], kind).data for chunk in chunks)
    out.write(padding(rows * kind.itemsize))
