"""Figures of a loop's timing: quantiles of its histograms, and wake-ups measured without a tick."""

import json
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Self

import numpy as np
import numpy.typing as npt

from rtcore.clock import now_ns, wait_until
from rtcore.loop import account, keep_time, warm_up
from rtcore.memory.layout import HISTOGRAM_BIN_S
from rtcore.memory.segment import Block, attach_block, private_block
from rtcore.realtime import Condition, take_all

Counts = npt.NDArray[np.int64]


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


def read_figures(path: Path) -> LoopFigures:
    """The figures of the loop whose block is at `path`. Raises `BlockError`."""
    block = attach_block(path)
    conditions = json.loads(block.fields["conditions"] or b"[]")
    return figures_of(block, tuple(Condition(**condition) for condition in conditions))


class _IdleCycle:
    """A cycle that does nothing but end the loop after so many deadlines."""

    def __init__(self, deadlines: int) -> None:
        self.left = deadlines
        self.missed = 0

    def __len__(self) -> int:
        return max(self.left, 0)

    def __call__(self, now_ns: int, latency_ns: int, tick_time_ns: int, missed: int) -> None:
        self.left -= 1 + missed
        self.missed += missed


@cache
def _conditions_of_this_process(cpu: int | None) -> tuple[Condition, ...]:
    warm_up()
    return tuple(take_all(cpu))


def _measure(seconds: float, period_ns: int, margin_ns: int, cpu: int | None) -> LoopFigures:
    conditions = _conditions_of_this_process(cpu)
    block = private_block(period_ns, seconds=0.01)
    idle = _IdleCycle(round(seconds * 1e9 / period_ns))
    keep_time(
        idle,
        wait_until,
        idle,
        account,
        block_address=block.address,
        start_ns=now_ns(),
        period_ns=period_ns,
        margin_ns=margin_ns,
    )
    block.fields["snapshot"]["deadlines_missed"] = idle.missed
    return figures_of(block, conditions)


class WakeupProbe:
    """Wakes up once a period under all conditions to be had, with no tick behind it.

    A process of its own does it, for real-time conditions outlive the call that took them.
    """

    def __init__(self, period_ns: int = 250_000, cpu: int | None = None) -> None:
        self.period_ns = period_ns
        self.cpu = cpu
        self._pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.shutdown()

    def measure(self, seconds: float, margin_ns: int) -> LoopFigures:
        """The figures of so many seconds."""
        return self._pool.submit(_measure, seconds, self.period_ns, margin_ns, self.cpu).result()
