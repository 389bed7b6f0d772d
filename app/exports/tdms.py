"""TDMS, as LabVIEW and DIAdem read it: one segment a chunk."""

from typing import BinaryIO

import numpy as np
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter

from app.exports.extract import Extract, Progress
from app.exports.told import documents, facts, unit
from rtcore.channels import CHANNEL

GROUP = "recording"


def write_tdms(out: BinaryIO, wanted: Extract, progress: Progress) -> None:
    """Units are where NI's programs look for them, and the timing too where no tick is missing.

    Settings belong to the file.
    """
    about = {name: _known(value) for name, value in facts(wanted.description).items()}
    root = RootObject({**about, **documents(wanted.description)})
    heads: list[RootObject | GroupObject] = [root, GroupObject(GROUP)]
    timing = _timing(wanted) if wanted.rows() == wanted.ticks else {}
    properties = {name: _properties(name) | timing for name in wanted.names}
    with TdmsWriter(out) as writer:
        for chunk in wanted.chunks(progress):
            channels = [
                ChannelObject(GROUP, name, np.ascontiguousarray(chunk[name]), properties[name])
                for name in wanted.names
            ]
            writer.write_segment([*heads, *channels])
            heads, properties = [], {name: {} for name in wanted.names}  # said once


def _properties(name: str) -> dict[str, str | float]:
    return {"unit_string": unit(name), "description": CHANNEL[name].doc}


def _timing(wanted: Extract) -> dict[str, str | float]:
    return {"wf_start_offset": wanted.from_s, "wf_increment": wanted.period_s}


def _known(value: str | int | float | bool) -> str | int | float | bool | np.int64:
    """An integer that may not fit into 32 bits."""
    return np.int64(value) if isinstance(value, int) and not isinstance(value, bool) else value
