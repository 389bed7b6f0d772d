"""A course from a tick within it on, and where a generator is set down there."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from app.definitions.expansion import course_of
from app.definitions.limits import RIG
from app.definitions.pieces import Node, Piece
from app.definitions.seeking import Place, seek
from rtcore.program.stream import Course


class Begun(NamedTuple):
    """What is left of a course, and a START record (`rtcore.program.play`) within its first segment."""

    course: Course
    start: Any


def begun_at(nodes: Sequence[Node], first: int) -> Begun:
    """The course of nodes from a tick on; of samples, only those that are still to be played."""
    place = seek(nodes, first)
    if not place.rest:
        return Begun(course_of([]), _start(place, 0))
    piece, *others = place.rest
    if not isinstance(piece, Piece) or piece.track is None:
        return Begun(course_of([place.rest]), _start(place, 0))
    gone = min(math.floor(place.tick * RIG.period_s * piece.rate_per_s), piece.times - 2)
    cut = replace(piece, track=replace(piece.track, begin=gone))
    return Begun(course_of([[cut, *others]]), _start(place, gone))


def _start(place: Place, knots_before: int) -> Any:
    state = place.state
    values = (state.value, state.mean, state.amplitude, state.frequency_hz, state.phase_cycles)
    return (*values, place.tick, knots_before)
