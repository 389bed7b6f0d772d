"""What a test comes to, before it runs: how long, how often, how far."""

from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict

from app.definitions.blocks import Block
from app.definitions.definition import Definition
from app.definitions.extent import Extent, Survey
from app.definitions.limits import RIG
from app.definitions.motions import Motion
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Node


class _Timed(BaseModel):
    model_config = ConfigDict(frozen=True)

    index: int
    kind: str
    start_s: float
    duration_s: float
    cycles: int


class BlockOutline(_Timed):
    """One block of the test: when, how long, how many counted cycles, between which forces."""

    min_force_n: float
    max_force_n: float


class MotionOutline(_Timed):
    """One motion of the unit under test."""

    min_displacement_m: float
    max_displacement_m: float


class Outline(BaseModel):
    """A test as it will run, from zero force and with the unit in its middle.

    The force program decides when a test ends: a longer motion is cut short.
    """

    model_config = ConfigDict(frozen=True)

    blocks: tuple[BlockOutline, ...]
    motion: tuple[MotionOutline, ...]
    duration_s: float
    motion_duration_s: float
    cycles: int
    peak_force_n: float
    peak_displacement_m: float


def outline(definition: Definition) -> Outline:
    """The outline of a definition, in closed form: a million repeats take no longer than one."""
    forces = _extents(force_nodes(definition.blocks, definition.controller.compensation))
    motions = _extents(motion_nodes(definition.motion))
    blocks = [
        BlockOutline(**timed, min_force_n=extent.low, max_force_n=extent.high)
        for timed, extent in _timed(definition.blocks, forces)
    ]
    motion = [
        MotionOutline(**timed, min_displacement_m=extent.low, max_displacement_m=extent.high)
        for timed, extent in _timed(definition.motion, motions)
    ]
    return Outline(
        blocks=tuple(blocks),
        motion=tuple(motion),
        duration_s=_duration_s(forces),
        motion_duration_s=_duration_s(motions),
        cycles=sum(extent.cycles for extent in forces),
        peak_force_n=_peak(forces),
        peak_displacement_m=_peak(motions),
    )


def _extents(blocks: Sequence[Sequence[Node]]) -> list[Extent]:
    survey = Survey()
    return [survey.measure(nodes) for nodes in blocks]


def _timed(
    items: Sequence[Block | Motion], extents: Sequence[Extent]
) -> Iterator[tuple[dict[str, Any], Extent]]:
    """What blocks and motions have in common, with the extent of each."""
    ticks = 0
    for i, (item, extent) in enumerate(zip(items, extents, strict=True)):
        yield (
            {
                "index": i,
                "kind": item.kind,
                "start_s": ticks * RIG.period_s,
                "duration_s": extent.ticks * RIG.period_s,
                "cycles": extent.cycles,
            },
            extent,
        )
        ticks += extent.ticks


def _duration_s(extents: Sequence[Extent]) -> float:
    return sum(extent.ticks for extent in extents) * RIG.period_s


def _peak(extents: Sequence[Extent]) -> float:
    return max((max(abs(e.low), abs(e.high)) for e in extents), default=0.0)
