"""HDF5: a dataset a channel, with its unit; facts as attributes of the file, settings as texts beside."""

from pathlib import Path

import h5py

from app.exports.extract import Extract, Progress, dtype_of
from app.exports.told import documents, facts, unit
from rtcore.channels import CHANNEL

CHUNK = 65_536  # rows
SETTINGS = "settings"  # each a text of JSON: an attribute could not hold more than 64 KB


def write_hdf5(path: Path, wanted: Extract, progress: Progress) -> None:
    """Compressed as every reader knows it (shuffle, gzip)."""
    rows = wanted.rows()
    with h5py.File(path, "w") as file:
        file.attrs.update(facts(wanted.description))
        settings = file.create_group(SETTINGS)
        for name, text in documents(wanted.description).items():
            settings.create_dataset(name, data=text)
        for name in wanted.names:
            _make(file, name, rows)
        at = 0
        for chunk in wanted.chunks(progress):
            end = at + len(chunk["tick"])
            for name in wanted.names:
                file[name][at:end] = chunk[name]
            at = end


def _make(file: h5py.File, name: str, rows: int) -> None:
    how = {"chunks": (min(CHUNK, rows),), "compression": "gzip", "compression_opts": 1}
    made = file.create_dataset(name, (rows,), dtype_of(name), shuffle=True, **how)
    made.attrs["unit"] = unit(name)
    made.attrs["description"] = CHANNEL[name].doc
