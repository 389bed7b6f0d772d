"""Plays a table through the loop's own generator."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from rtcore.compiled import address_of, carray, entry, pointer
from rtcore.program.generator import GENERATOR, generate, start
from rtcore.program.segments import TABLE

PERIOD_S = 250e-6
COLUMNS = 5


class Played(NamedTuple):
    """Tick by tick, each (n,): the setpoint, and what goes with it."""

    value: npt.NDArray[np.float64]
    cycle: npt.NDArray[np.int64]
    block: npt.NDArray[np.int64]
    branch: npt.NDArray[np.int64]
    ended: npt.NDArray[np.bool_]

    @property
    def ticks(self) -> int:
        """Ticks until the program was over."""
        return int(np.argmax(self.ended)) if self.ended.any() else -1


@entry
def _play(
    g_address: int, table_address: int, out_address: int, ticks: int, period_s: float
) -> None:
    g = carray(pointer(g_address), 1, GENERATOR)[0]
    table = carray(pointer(table_address), 1, TABLE)[0]
    out = carray(pointer(out_address), (ticks, COLUMNS), np.float64)
    start(g, table, 0.0, period_s)
    for i in range(ticks):
        generate(g, table, False, False, 1000, 2000, period_s)
        out[i, 0] = g.value
        out[i, 1] = g.cycle
        out[i, 2] = g.block
        out[i, 3] = g.branch
        out[i, 4] = g.ended


def play(table: Any, ticks: int) -> Played:
    """So many ticks of a TABLE record from a setpoint of 0."""
    tables, generators = np.array([table]), np.zeros(1, GENERATOR)
    out = np.zeros((ticks, COLUMNS))
    _play(address_of(generators), address_of(tables), address_of(out), ticks, PERIOD_S)
    whole = out.astype(np.int64)
    return Played(out[:, 0], whole[:, 1], whole[:, 2], whole[:, 3], out[:, 4] > 0)
