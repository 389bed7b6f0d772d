"""What a test will do, before it runs: its setpoints from the loop's own generator, bin by bin."""

import math
from collections.abc import Sequence
from itertools import chain
from typing import Any

from pydantic import BaseModel, ConfigDict

from app.definitions.definition import Definition
from app.definitions.extent import Survey
from app.definitions.limits import RIG
from app.definitions.midway import begun_at
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Node
from rtcore.program.play import Player

LONGEST_S = 7200.0  # of a window; it is played tick by tick, an hour in about a second
MOST_POINTS = 20_000


class Peaks(BaseModel):
    """The greatest of each within the window, either way, and the second of the test at which it is.

    A rate is the change in a tick; that of a sudden step says only that it is sudden.
    """

    model_config = ConfigDict(frozen=True)

    force_n: float
    force_at_s: float
    force_rate_n_s: float
    force_rate_at_s: float
    displacement_m: float
    displacement_at_s: float
    velocity_m_s: float
    velocity_at_s: float


class Preview(BaseModel):
    """A window of a test. `decimated`: a point is the least and greatest of more than one tick.

    `shortened`: the window would have been longer than is played. `time_s` is where a point begins,
    `block` the block at that moment.
    """

    model_config = ConfigDict(frozen=True)

    duration_s: float
    from_s: float
    to_s: float
    decimated: bool
    shortened: bool
    time_s: list[float]
    force_min_n: list[float]
    force_max_n: list[float]
    displacement_min_m: list[float]
    displacement_max_m: list[float]
    block: list[int]
    peaks: Peaks


def preview(
    definition: Definition, from_s: float = 0.0, to_s: float | None = None, points: int = 1000
) -> Preview:
    """The setpoints of a test from a second to another; all of it, up to two hours, where none is given.

    Where in the test the window lies makes no difference to how long this takes.
    """
    force = list(chain(*force_nodes(definition.blocks, definition.controller.compensation)))
    motion = list(chain(*motion_nodes(definition.motion)))
    whole = max(Survey().measure(force).ticks, 1)
    first = min(max(_ticks(from_s), 0), whole - 1)
    wanted = whole if to_s is None else min(max(_ticks(to_s), first + 1), whole)
    last = min(wanted, first + _ticks(LONGEST_S))
    ticks = last - first
    bins = min(points, MOST_POINTS, ticks)
    force_bins, force_tape = _player(force, first).play(ticks, bins)
    motion_bins, motion_tape = _player(motion, first).play(ticks, bins)
    return Preview(
        duration_s=whole * RIG.period_s,
        from_s=first * RIG.period_s,
        to_s=last * RIG.period_s,
        decimated=bins < ticks,
        shortened=last < wanted,
        time_s=[(first - -i * ticks // bins) * RIG.period_s for i in range(bins)],
        force_min_n=force_bins["low"].tolist(),
        force_max_n=force_bins["high"].tolist(),
        displacement_min_m=motion_bins["low"].tolist(),
        displacement_max_m=motion_bins["high"].tolist(),
        block=force_bins["block"].tolist(),
        peaks=_peaks(force_tape, motion_tape, first),
    )


def _ticks(seconds: float) -> int:
    return math.floor(min(seconds, RIG.duration_limit_s) * RIG.loop_rate_hz + 0.5)


def _player(nodes: Sequence[Node], first: int) -> Player:
    """A player set down at a tick of nodes."""
    begun = begun_at(nodes, first)
    return Player(begun.course, RIG.period_s, begun.start)


def _peaks(force: Any, motion: Any, first: int) -> Peaks:
    def at_s(tick: int) -> float:
        return (first + int(tick)) * RIG.period_s

    return Peaks(
        force_n=abs(force["peak"]),
        force_at_s=at_s(force["peak_tick"]),
        force_rate_n_s=abs(force["steepest"]) * RIG.loop_rate_hz,
        force_rate_at_s=at_s(force["steepest_tick"]),
        displacement_m=abs(motion["peak"]),
        displacement_at_s=at_s(motion["peak_tick"]),
        velocity_m_s=abs(motion["steepest"]) * RIG.loop_rate_hz,
        velocity_at_s=at_s(motion["steepest_tick"]),
    )
