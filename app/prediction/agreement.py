"""For how long a shortened test is the whole one, tick for tick: so far its prediction is that of the whole."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from operator import attrgetter

from app.definitions.definition import Definition
from app.definitions.extent import AT_REST, after, ticks_of
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Node, Piece
from rtcore.program.segments import SEGMENT, Segment

_CONTENT = attrgetter(
    *(name for name in SEGMENT.names or () if name not in ("block", "jump", "times", "ticks"))
)
_ALIKE_THROUGHOUT = (Segment.HOLD,)


def same_ticks(whole: Definition, shorter: Definition, at_most: int) -> int:
    """Ticks of the program from its first, over which both give the same setpoints; at most so many."""
    compensation = whole.controller.compensation
    forces = [_pieces(force_nodes(d.blocks, compensation)) for d in (whole, shorter)]
    motions = [_pieces(motion_nodes(d.motion)) for d in (whole, shorter)]
    return min(_same(first, second, at_most) for first, second in (forces, motions))


def _same(whole: Iterable[Piece], shorter: Iterable[Piece], at_most: int) -> int:
    state, ticks = AT_REST, 0
    for a, b in zip_longest(whole, shorter):
        if a is None or b is None or not _alike(a, b):
            return min(ticks, at_most)
        first, second = ticks_of(a, state), ticks_of(b, state)
        if first != second:
            steady = a.kind in _ALIKE_THROUGHOUT or bool(a.counts)
            return min(ticks + min(first, second) * steady, at_most)
        state, ticks = after(a, state), ticks + first
        if ticks >= at_most:
            return at_most
    return at_most


def _alike(a: Piece, b: Piece) -> bool:
    return _CONTENT(a) == _CONTENT(b) and getattr(a, "track", None) == getattr(b, "track", None)


def _pieces(blocks: Sequence[Sequence[Node]]) -> Iterator[Piece]:
    return _unrolled(node for nodes in blocks for node in nodes)


def _unrolled(nodes: Iterable[Node]) -> Iterator[Piece]:
    for node in nodes:
        if isinstance(node, Piece):
            yield node
        else:
            for _ in range(node.times):
                yield from _unrolled(node.body)
