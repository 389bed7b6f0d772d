"""The binary frame of samples, as docs/wire.md has it."""

import struct
from collections.abc import Sequence
from typing import Any

import numpy.typing as npt

VERSION = 1
SAMPLES = 1
HEADER = struct.Struct("<BBHIqII")
MOST_LOST = 2**32 - 1


class Stretch:
    """(n,) TELEMETRY of consecutive ticks on their way to many browsers: most ask for the same channels."""

    def __init__(self, records: npt.NDArray[Any]) -> None:
        self.records = records
        self._columns: dict[tuple[str, ...], bytes] = {}

    def frame(self, channels: Sequence[str], lost_ticks: int, subscription: int) -> bytes:
        """As a frame, channel after channel in float32; what is alike for all is made once."""
        header = HEADER.pack(
            *(VERSION, SAMPLES, len(channels), len(self.records)),
            *(int(self.records["tick"][0]), min(lost_ticks, MOST_LOST), subscription),
        )
        return header + self._columns_of(tuple(channels))

    def _columns_of(self, channels: tuple[str, ...]) -> bytes:
        made = self._columns.get(channels)
        if made is None:
            made = b"".join(self.records[name].astype("<f4").tobytes() for name in channels)
            self._columns[channels] = made
        return made
