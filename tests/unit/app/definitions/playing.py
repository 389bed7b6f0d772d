"""Plays a course through the loop's own generator, fed as the loop is fed."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from rtcore.compiled import address_of, carray, entry, pointer
from rtcore.program.generator import GENERATOR, generate, refresh, start
from rtcore.program.segments import TABLE
from rtcore.program.stream import Course, TableWriter

PERIOD_S = 250e-6
COLUMNS = 6
STRETCH = 256  # ticks between two feedings


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
def _begin(g_address: int, table_address: int, period_s: float) -> None:
    g = carray(pointer(g_address), 1, GENERATOR)[0]
    start(g, carray(pointer(table_address), 1, TABLE)[0], 0.0, period_s)


@entry
def _play(
    g_address: int, table_address: int, out_address: int, ticks: int, period_s: float
) -> None:
    g = carray(pointer(g_address), 1, GENERATOR)[0]
    table = carray(pointer(table_address), 1, TABLE)[0]
    out = carray(pointer(out_address), (ticks, COLUMNS), np.float64)
    refresh(g, table.count, table.knot_count)
    for i in range(ticks):
        generate(g, table, False, False, 1000, 2000, period_s)
        out[i, 0] = g.value
        out[i, 1] = g.cycle
        out[i, 2] = g.block
        out[i, 3] = g.branch
        out[i, 4] = g.ended
        out[i, 5] = g.starved


def play(course: Course, ticks: int) -> Played:
    """So many ticks of a course from a setpoint of 0."""
    tables, generators = np.zeros(1, TABLE), np.zeros(1, GENERATOR)
    writer = TableWriter(tables[0], course)
    out = np.zeros((ticks, COLUMNS))
    g: Any = generators[0]
    _begin(address_of(generators), address_of(tables), PERIOD_S)
    for first in range(0, ticks, STRETCH):
        part = out[first : first + STRETCH]
        _play(address_of(generators), address_of(tables), address_of(part), len(part), PERIOD_S)
        writer.fill(int(g["segment"]), int(g["knot"]))
    assert not out[:, 5].any(), "the generator was kept waiting"
    whole = out.astype(np.int64)
    return Played(out[:, 0], whole[:, 1], whole[:, 2], whole[:, 3], out[:, 4] > 0)
