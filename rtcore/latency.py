"""Figures of a loop's timing: quantiles of its histograms, and a probe that measures some."""

import signal
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context
from typing import Protocol, Self

import numpy as np
import numpy.typing as npt

from rtcore.clock import now_ns, wait_until
from rtcore.loop import account, keep_time, warm_up
from rtcore.memory.layout import HISTOGRAM_BIN_S, HISTOGRAM_BINS
from rtcore.memory.segment import Block, private_block
from rtcore.realtime import Condition, take_all

Counts = npt.NDArray[np.int64]
BIN_S = HISTOGRAM_BIN_S
RANGE_US = HISTOGRAM_BINS - 1  # what is longer lies in the last bin


@dataclass(frozen=True)
class LoopFigures:
    """What a loop did: histograms of (HISTOGRAM_BINS,) counts, bins of HISTOGRAM_BIN_S."""

    wakeup: Counts
    tick_time: Counts
    late_ticks: int
    deadlines_missed: int
    conditions: tuple[Condition, ...]

    @property
    def ticks(self) -> int:
        """How many ticks the loop has executed."""
        return int(self.wakeup.sum())

    def __add__(self, other: Self) -> Self:
        """Both together; they were measured under the same conditions."""
        return replace(
            self,
            wakeup=self.wakeup + other.wakeup,
            tick_time=self.tick_time + other.tick_time,
            late_ticks=self.late_ticks + other.late_ticks,
            deadlines_missed=self.deadlines_missed + other.deadlines_missed,
        )


def quantile_s(counts: Counts, share: float) -> float | None:
    """The time (s) that this share (0 < share ≤ 1) of the counts does not exceed.

    It is interpolated within its bin. None where there is no count, or where it lies in the last
    bin, which has no upper edge.
    """
    up_to = np.cumsum(counts)
    rank = share * up_to[-1]
    found = int(np.searchsorted(up_to, rank))
    if up_to[-1] == 0 or found >= len(counts) - 1:
        return None
    before = up_to[found - 1] if found else 0
    return float((found + (rank - before) / counts[found]) * HISTOGRAM_BIN_S)


def longest_s(counts: Counts) -> float | None:
    """Upper edge (s) of the longest bin that has a count; None where that bin is the last."""
    filled = np.flatnonzero(counts)
    if len(filled) == 0 or filled[-1] == len(counts) - 1:
        return None
    return float((filled[-1] + 1) * HISTOGRAM_BIN_S)


def figures_of(block: Block, conditions: tuple[Condition, ...]) -> LoopFigures:
    """A copy of the figures that a loop keeps in its block."""
    fields = block.fields
    return LoopFigures(
        fields["wakeup_histogram"].copy(),
        fields["tick_time_histogram"].copy(),
        int(fields["late_ticks"]),
        int(fields["snapshot"]["deadlines_missed"]),
        conditions,
    )


class Bound(Protocol):
    """A rig bound to its block, as the loop drives it; `rtcore.io.simulated.SimulatedIo` is one."""

    block: Block

    def cycle(self, now_ns: int, wakeup_latency_ns: int, tick_time_ns: int, missed: int) -> None:
        """One tick."""


class Idle:
    """No rig and no tick: only the wake-ups are measured."""

    def __init__(self, period_ns: int) -> None:
        self.block = private_block(period_ns, seconds=0.01)

    def cycle(self, now_ns: int, wakeup_latency_ns: int, tick_time_ns: int, missed: int) -> None:
        """Nothing but a count of what was missed, as the tick keeps it."""
        if missed:
            self.block.fields["snapshot"]["deadlines_missed"] += missed


Make = Callable[[int], Bound]  # period_ns → what is to be driven; a function of a module


@cache
def _armed(make: Make, period_ns: int, cpu: int | None) -> tuple[Bound, tuple[Condition, ...]]:
    bound = make(period_ns)
    warm_up()
    return bound, tuple(take_all(cpu))


def _measure(
    make: Make, period_ns: int, cpu: int | None, seconds: float, margin_ns: int
) -> LoopFigures:
    bound, conditions = _armed(make, period_ns, cpu)
    fields = bound.block.fields
    for figure in ("wakeup_histogram", "tick_time_histogram", "late_ticks"):
        fields[figure] = 0
    missed_before = int(fields["snapshot"]["deadlines_missed"])
    running = [True]
    signal.signal(signal.SIGALRM, lambda *_: running.clear())
    signal.setitimer(signal.ITIMER_REAL, seconds)
    keep_time(
        running,
        wait_until,
        bound.cycle,
        account,
        block_address=bound.block.address,
        start_ns=now_ns(),
        period_ns=period_ns,
        margin_ns=margin_ns,
    )
    found = figures_of(bound.block, conditions)
    return replace(found, deadlines_missed=found.deadlines_missed - missed_before)


class LoopProbe:
    """Runs the loop's own shell for some seconds at a time, in a process of its own.

    Real-time conditions outlive the call that took them, so they are taken there, once.
    """

    def __init__(self, make: Make, period_ns: int, cpu: int | None = None) -> None:
        self._arguments = (make, period_ns, cpu)
        self._pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.shutdown()

    def measure(self, seconds: float, margin_ns: int) -> LoopFigures:
        """The figures of so many seconds."""
        return self._pool.submit(_measure, *self._arguments, seconds, margin_ns).result()
