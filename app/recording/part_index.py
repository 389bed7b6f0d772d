"""Where in a part which tick begins: a row about once a second, so that a reader can begin in the middle.

A row is written after the batch that it points to. It is derived: a part is readable without its index,
only from the start then.
"""

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

ENTRY = np.dtype([("offset", "i8"), ("tick", "i8"), ("ticks_before", "i8")])
EVERY_TICKS = 4096


def index_path(part: Path) -> Path:
    """The index of a part."""
    return part.with_suffix(".index")


class IndexWriter:
    """Appends to the index of a part."""

    def __init__(self, part: Path) -> None:
        self._file = index_path(part).open("wb", buffering=0)
        self._ticks = 0
        self._next = 0

    def add(self, offset: int, ticks: npt.NDArray[Any]) -> None:
        """A batch of these ticks has been written at this offset. Raises `OSError`."""
        if self._ticks >= self._next:
            self._file.write(np.array([(offset, ticks[0], self._ticks)], ENTRY).tobytes())
            self._next = self._ticks + EVERY_TICKS
        self._ticks += len(ticks)

    def close(self) -> None:
        self._file.close()


def read_index(part: Path) -> npt.NDArray[Any]:
    """(n,) ENTRY in ascending order; empty where there is none, or it cannot be of this part."""
    try:
        content, size = index_path(part).read_bytes(), part.stat().st_size
    except OSError:
        return np.empty(0, ENTRY)
    rows = np.frombuffer(content[: len(content) // ENTRY.itemsize * ENTRY.itemsize], ENTRY)
    rows = rows[: int(np.searchsorted(rows["offset"], size))]
    rising = all(bool(np.all(np.diff(rows[name]) > 0)) for name in ENTRY.names or ())
    return rows if rising else np.empty(0, ENTRY)


def entry_before(part: Path, tick: int) -> tuple[int, int]:
    """The offset of the last indexed batch that begins at `tick` or before, and the ticks before it.

    (0, 0), the start of the part, where the index does not know better.
    """
    rows = read_index(part)
    place = int(np.searchsorted(rows["tick"], tick, side="right")) - 1
    return (int(rows["offset"][place]), int(rows["ticks_before"][place])) if place >= 0 else (0, 0)
