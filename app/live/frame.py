"""The binary frame of samples, as docs/wire.md has it."""

import struct
from collections.abc import Sequence
from typing import Any

import numpy.typing as npt

VERSION = 1
SAMPLES = 1
HEADER = struct.Struct("<BBHIqII")
MOST_LOST = 2**32 - 1


def sample_frame(
    records: npt.NDArray[Any], channels: Sequence[str], lost_ticks: int, subscription: int
) -> bytes:
    """(n,) TELEMETRY of consecutive ticks as a frame, channel after channel in float32."""
    header = HEADER.pack(
        *(VERSION, SAMPLES, len(channels), len(records)),
        *(int(records["tick"][0]), min(lost_ticks, MOST_LOST), subscription),
    )
    return header + b"".join(records[name].astype("<f4").tobytes() for name in channels)
