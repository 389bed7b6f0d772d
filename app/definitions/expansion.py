"""From a definition to the PROGRAM record that the loop walks through."""

from collections.abc import Iterable, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Loop, Node, Piece
from rtcore.program.segments import PROGRAM, SEGMENT, Segment

if TYPE_CHECKING:
    from app.definitions.definition import Definition

_SHARED = [f.name for f in fields(Piece) if f.name in (SEGMENT.names or ())]


def expand(definition: "Definition") -> Any:
    """The definition as a PROGRAM record, () of dtype PROGRAM: one table for force, one for motion.

    `block` of each segment is the number of the block (or motion) of the test that it serves.
    """
    program = np.zeros((), PROGRAM)
    compensation = definition.controller.compensation
    _fill(program["force"], force_nodes(definition.blocks, compensation))
    _fill(program["motion"], motion_nodes(definition.motion))
    return program


def segments_in(nodes: Iterable[Node]) -> int:
    """How many segments nodes take in a table, their loops' own included."""
    return sum(1 if isinstance(n, Piece) else 1 + segments_in(n.body) for n in nodes)


def loops_within(nodes: Iterable[Node]) -> int:
    """How many loops deep nodes are."""
    return max((1 + loops_within(n.body) for n in nodes if isinstance(n, Loop)), default=0)


def _fill(table: Any, blocks: Sequence[Sequence[Node]]) -> None:
    count = 0
    for number, nodes in enumerate(blocks):
        count = _write(table["segments"], count, nodes, number)
    last = max(len(blocks) - 1, 0)
    table["segments"][count]["kind"] = Segment.END
    table["segments"][count]["block"] = last
    table["count"] = count + 1


def _write(segments: Any, place: int, nodes: Iterable[Node], number: int) -> int:
    """Write nodes from a place on; returns the place after them."""
    for node in nodes:
        first = place
        if isinstance(node, Piece):
            for name in _SHARED:
                segments[place][name] = getattr(node, name)
        else:
            place = _write(segments, place, node.body, number)
            segments[place]["kind"] = Segment.REPEAT
            segments[place]["jump"] = first
            segments[place]["times"] = node.times
        segments[place]["block"] = number
        place += 1
    return place
