"""From a definition to the program that the loop plays, given bit by bit where it is long."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain, islice
from typing import Any

import numpy as np
import numpy.typing as npt

from app.definitions.definition import Definition
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Loop, Node, Piece, unrolled
from rtcore.program.segments import KNOT, MAX_SEGMENTS, SEGMENT, Segment
from rtcore.program.stream import Course, Program

Records = npt.NDArray[Any]

_NAMES = [name for name in SEGMENT.names or () if name not in ("block", "jump")]
_TOGETHER = 512  # segments given at once where they are given bit by bit


def expand(definition: Definition) -> Program:
    """The definition as a load program: a course of force and one of motion.

    `block` of each segment is the number of the block (or motion) of the test that it serves. A
    course that fits into the loop's table keeps its repeats; a longer one is unrolled as it is
    played. Knots of samples are read from their files as they are played.
    """
    force = force_nodes(definition.blocks, definition.controller.compensation)
    motion = motion_nodes(definition.motion)
    return Program(course_of(force), course_of(motion))


def course_of(blocks: Sequence[Sequence[Node]]) -> Course:
    """The nodes of blocks as a course."""
    nodes = list(chain.from_iterable(blocks))
    if segments_in(nodes) < MAX_SEGMENTS:
        segments: Iterable[Records] = (_table(nodes),)
    else:
        segments = _Again(lambda: _unrolled_segments(nodes))
    return Course(segments, _Again(lambda: _knots(_with_tracks(nodes))))


def segments_in(nodes: Iterable[Node]) -> int:
    """How many segments nodes take in a table, their loops' own included."""
    return sum(1 if isinstance(n, Piece) else 1 + segments_in(n.body) for n in nodes)


class _Again:
    """Arrays that are made as they are asked for, from the first on whenever asked again."""

    def __init__(self, make: Callable[[], Iterator[Records]]) -> None:
        self._make = make

    def __iter__(self) -> Iterator[Records]:
        return self._make()


def _block(node: Node) -> int:
    """The number of the block that a node serves."""
    return int(node.origin[1]) if len(node.origin) > 1 else 0


def _records(pieces: Sequence[Piece]) -> Records:
    records = np.zeros(len(pieces), SEGMENT)
    for name in _NAMES:
        records[name] = [getattr(piece, name) for piece in pieces]
    records["block"] = [_block(piece) for piece in pieces]
    return records


def _end(block: int) -> Records:
    record = np.zeros(1, SEGMENT)
    record["kind"], record["block"] = Segment.END, block
    return record


def _table(nodes: Sequence[Node]) -> Records:
    """Every node with its repeats, END last."""
    table = np.zeros(segments_in(nodes) + 1, SEGMENT)
    table[-1:] = _end(_block(nodes[-1]) if nodes else 0)
    placed = list(_laid(table, 0, nodes))
    table[[place for place, _ in placed]] = _records([piece for _, piece in placed])
    return table


def _laid(table: Records, place: int, nodes: Iterable[Node]) -> Iterator[tuple[int, Piece]]:
    """Write the repeats of nodes from a place on; gives each piece with its own place."""
    for node in nodes:
        if isinstance(node, Piece):
            yield place, node
        else:
            first = place
            yield from _laid(table, first, node.body)
            place += segments_in(node.body)
            table[place]["kind"] = Segment.REPEAT
            table[place]["jump"] = first
            table[place]["times"] = node.times
            table[place]["block"] = _block(node)
        place += 1


def _unrolled_segments(nodes: Sequence[Node]) -> Iterator[Records]:
    for together in _batched(unrolled(nodes)):
        yield _records(together)
    yield _end(_block(nodes[-1]))


def _with_tracks(nodes: Iterable[Node]) -> list[Node]:
    """What is left of nodes where only samples count, so that nothing else need be unrolled."""
    kept: list[Node] = []
    for node in nodes:
        if isinstance(node, Loop):
            body = tuple(_with_tracks(node.body))
            kept += [Loop(node.times, body, node.origin)] if body else []
        elif node.track is not None:
            kept.append(node)
    return kept


def _knots(nodes: Iterable[Node]) -> Iterator[Records]:
    for piece in unrolled(nodes):
        for values, slopes in piece.track.knots() if piece.track else ():
            knots = np.empty(len(values), KNOT)
            knots["value"], knots["slope"] = values, slopes
            yield knots


def _batched(pieces: Iterator[Piece]) -> Iterator[Sequence[Piece]]:
    while together := list(islice(pieces, _TOGETHER)):
        yield together
