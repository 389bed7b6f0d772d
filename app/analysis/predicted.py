"""The force that was predicted for a run, by tick of its program, read as the run goes by."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from app.analysis.walk import Columns, Ticks


class Predicted:
    """Looks up the predicted force. Ticks are asked for in ascending order, each once."""

    def __init__(self, chunks: Iterable[Columns]) -> None:
        """Chunks in order with the columns `program_tick` and `force_n`; some ticks may lack."""
        self._chunks = iter(chunks)
        self._ticks = np.zeros(0, np.int64)
        self._force_n = np.zeros(0)

    def at(self, positions: Ticks) -> npt.NDArray[np.float64]:
        """(n,) the force at ticks of the program; NaN where none was predicted."""
        self._read_to(int(positions[0]), int(positions[-1]))
        found = np.full(len(positions), np.nan)
        if len(self._ticks):
            places = np.minimum(np.searchsorted(self._ticks, positions), len(self._ticks) - 1)
            known = self._ticks[places] == positions
            found[known] = self._force_n[places[known]]
        return found

    def _read_to(self, first: int, last: int) -> None:
        """Have what there is from a tick to another, and forget what is before."""
        low = int(np.searchsorted(self._ticks, first))
        ticks, force_n = [self._ticks[low:]], [self._force_n[low:]]
        reached = int(self._ticks[-1]) if len(self._ticks) else -1
        while reached < last and (chunk := next(self._chunks, None)) is not None:
            fresh = np.asarray(chunk["program_tick"], np.int64)
            low = int(np.searchsorted(fresh, first))
            ticks.append(fresh[low:])
            force_n.append(np.asarray(chunk["force_n"], np.float64)[low:])
            reached = int(fresh[-1]) if len(fresh) else reached
        self._ticks, self._force_n = np.concatenate(ticks), np.concatenate(force_n)
