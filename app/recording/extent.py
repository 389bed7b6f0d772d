"""Which ticks of a recording under way are whole on the disk."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from app.recording.part_index import read_index
from app.recording.parts import part_paths, read_part


@dataclass(frozen=True)
class Extent:
    """Which ticks of a run are recorded; the first and last are -1 where there are none."""

    first_tick: int = -1
    last_tick: int = -1
    ticks: int = 0

    def grown_by(self, ticks: npt.NDArray[Any]) -> "Extent":
        """With these ascending ticks after it."""
        first = int(ticks[0]) if self.ticks == 0 else self.first_tick
        return Extent(first, int(ticks[-1]), self.ticks + len(ticks))


def extent_of(folder: Path) -> Extent:
    """What is whole on disk of a recording under way.

    Only the end of each part is read and verified, from where its index last points to: an app that
    comes back must go on before the ring laps it, however long the run. `convert` verifies all.
    """
    extent = Extent()
    for path in part_paths(folder):
        extent = _with_part(extent, path)
    return extent


def _with_part(extent: Extent, path: Path) -> Extent:
    index = read_index(path)
    if len(index) and int(index["tick"][0]) > extent.last_tick:
        last = index[-1]
        tail = list(_ticks(path, int(last["offset"])))
        if tail and tail[0][0] == last["tick"]:
            first = int(index["tick"][0]) if extent.ticks == 0 else extent.first_tick
            indexed = Extent(first, int(last["tick"]) - 1, extent.ticks + int(last["ticks_before"]))
            return _grown(indexed, tail)
    return _grown(extent, _ticks(path, 0))


def _ticks(path: Path, offset: int) -> Iterable[npt.NDArray[Any]]:
    return (batch.column("tick").to_numpy() for batch in read_part(path, offset=offset))


def _grown(extent: Extent, stretches: Iterable[npt.NDArray[Any]]) -> Extent:
    """With what is new in these; a part may repeat the end of the one before it."""
    for ticks in stretches:
        fresh = ticks[int(np.searchsorted(ticks, extent.last_tick, side="right")) :]
        if len(fresh):
            extent = extent.grown_by(fresh)
    return extent
