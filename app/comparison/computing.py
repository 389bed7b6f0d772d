"""Lays runs over each other: windows of all of them side by side, so memory does not grow with their length."""

from collections.abc import Callable, Iterator

import numpy as np

from app.analysis.mean_cycle import MeanCycle
from app.analysis.overlay import Band, Bools, Difference, Floats, bin_width, put
from app.analysis.walk import NEEDED
from app.comparison.order import Laid, Order, Side
from app.comparison.schemas import Align, OverlayOut
from app.comparison.told import told
from app.definitions.windows import stretches
from app.errors import Code, Refusal
from app.recording.samples import Samples, open_samples
from app.runs.measuring import read_definition

WINDOW_TICKS = 65_536
PHASES = 361  # places of a cycle, both ends in it

Progress = Callable[[float], None]


def overlay(report: Progress, order: Order) -> OverlayOut | Refusal:
    """The runs of an order on one axis."""
    samples = []
    for side in order.sides:
        found = open_samples(side.folder)
        if found is None:
            return Refusal(Code.NO_DATA, f"Run {side.run_id} has no samples: leave it out")
        samples.append(found)
    if order.align is Align.PHASE:
        return _over_a_cycle(report, order, samples)
    return _over_time(report, order, samples)


def ticks_of(order: Order) -> int:
    """How many places have to be filled at most, of all runs and channels."""
    lengths = [side_ticks(side) for side in order.sides]
    places = sum(lengths) if order.align is Align.BLOCK else max(lengths)
    return places * len(order.sides) * len(order.channels)


def side_ticks(side: Side) -> int:
    """From a run's first tick to its last on disk, those that were not recorded among them."""
    samples = open_samples(side.folder)
    return 0 if samples is None else samples.last_tick - _begin(side, samples) + 1


def _over_time(report: Progress, order: Order, samples: list[Samples]) -> OverlayOut | Refusal:
    period_s = order.sides[0].period_s
    origins: list[int] = []
    for side, there in zip(order.sides, samples, strict=True):
        origin = _origin(side, there, order.block if order.align is Align.BLOCK else None)
        if origin is None:
            detail = f"Run {side.run_id} has no block {order.block}, or did not get there"
            return Refusal(Code.NO_DATA, f"{detail}: leave it out, or align in time")
        origins.append(origin)
    both = list(zip(samples, origins, strict=True))
    begin = min(there.first_tick - origin for there, origin in both)
    end = max(there.last_tick - origin for there, origin in both)
    first = max(begin, round(order.from_s / period_s))
    last = end if order.to_s is None else min(end, round(order.to_s / period_s))
    if last < first:
        return _nothing_there(order, begin * period_s, end * period_s)
    places = last - first + 1
    width = bin_width(places, order.points)
    bins = -(-places // width)
    found = {name: _empty(order, bins, width) for name in order.channels}
    for at, recorded, columns in _windows(order, samples, origins, first, places):
        for name, of_channel in found.items():
            _take(of_channel, at, columns[name], recorded)
        report(min(1.0, (at + WINDOW_TICKS) / places))
    x = np.asarray((first + np.arange(bins) * width) * period_s, np.float64)
    offsets = [
        (origin - _begin(side, there)) * period_s
        for side, there, origin in zip(order.sides, samples, origins, strict=True)
    ]
    return told(order, found, x, period_s, width > 1, [round(offset, 9) for offset in offsets])


def _over_a_cycle(report: Progress, order: Order, samples: list[Samples]) -> OverlayOut | Refusal:
    phases = np.linspace(0.0, 1.0, PHASES)
    columns: dict[str, list[Floats]] = {name: [] for name in order.channels}
    for done, (side, there) in enumerate(zip(order.sides, samples, strict=True)):
        begin = _begin(side, there)
        program = stretches(read_definition(side.definition, order.histories))
        cycle = MeanCycle(program, order.channels, side.period_s, begin, order.block)
        names = tuple(dict.fromkeys([*NEEDED, *order.channels]))
        for chunk in there.chunks(names, there.first_tick, there.last_tick):
            cycle.take(chunk)
        found = cycle.at(phases)
        if found is None:
            where = "" if order.block is None else f" in block {order.block}"
            detail = f"Run {side.run_id} has no whole cycle of a sine{where}: align in time instead"
            return Refusal(Code.NO_DATA, detail)
        for name, values in found.items():
            columns[name].append(values)
        report((done + 1) / len(samples))
    made = {name: _empty(order, PHASES, 1) for name in order.channels}
    for name, of_channel in made.items():
        _take(of_channel, 0, columns[name], [np.ones(PHASES, np.bool_)] * len(samples))
    return told(order, made, 360 * phases, 360.0 / (PHASES - 1), False, [None] * len(samples))


def _windows(
    order: Order, samples: list[Samples], origins: list[int], first: int, places: int
) -> Iterator[tuple[int, list[Bools], dict[str, list[Floats]]]]:
    """The place of each window, which of its ticks each run has, and each channel of all runs, tick by tick."""
    for at in range(0, places, WINDOW_TICKS):
        count = min(WINDOW_TICKS, places - at)
        columns: dict[str, list[Floats]] = {name: [] for name in order.channels}
        recorded: list[Bools] = []
        for there, origin in zip(samples, origins, strict=True):
            low = origin + first + at
            ticks = np.zeros(count, np.bool_)
            window = {name: np.full(count, np.nan) for name in order.channels}
            for chunk in there.chunks(order.channels, low, low + count - 1):
                put(ticks, chunk["tick"] - low, np.ones(len(chunk["tick"]), np.bool_))
                for name, values in window.items():
                    put(values, chunk["tick"] - low, chunk[name])
            recorded.append(ticks)
            for name, values in window.items():
                columns[name].append(values)
        yield at, recorded, columns


def _empty(order: Order, bins: int, width: int) -> Laid:
    others = order.sides[1:]
    return Laid(
        [Band(bins, width) for _ in order.sides],
        [Difference(bins, width, order.tolerance) for _ in others],
    )


def _take(found: Laid, at: int, of_runs: list[Floats], recorded: list[Bools]) -> None:
    for band, values in zip(found.series, of_runs, strict=True):
        band.take(at, values)
    baseline, there = of_runs[0], recorded[0]
    others = zip(found.differences, of_runs[1:], recorded[1:], strict=True)
    for difference, values, too in others:
        difference.take(at, baseline, values, there & too)


def _begin(side: Side, samples: Samples) -> int:
    return samples.first_tick if side.first_tick is None else side.first_tick


def _origin(side: Side, samples: Samples, block: int | None) -> int | None:
    """The tick that lies at the axis' zero; None where the run has none."""
    if block is None:
        return _begin(side, samples)
    for chunk in samples.chunks(("block",), samples.first_tick, samples.last_tick):
        there = np.flatnonzero(chunk["block"] == block)
        if len(there):
            return int(chunk["tick"][there[0]])
    return None


def _nothing_there(order: Order, begin_s: float, end_s: float) -> Refusal:
    to = "on" if order.to_s is None else f"to {order.to_s:g} s"
    detail = (
        f"Nothing was recorded from {order.from_s:g} s {to}: the first of these runs begins at "
        f"{begin_s:.6g} s, the last ends at {end_s:.6g} s"
    )
    return Refusal(Code.NO_DATA, detail)
