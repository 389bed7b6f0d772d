"""A course from a tick within it on, and where a generator is set down there."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from app.definitions.expansion import course_of
from app.definitions.extent import AT_REST
from app.definitions.limits import RIG
from app.definitions.pieces import SWINGING, Node, Piece
from app.definitions.seeking import Place, seek
from rtcore.program.segments import Segment
from rtcore.program.stream import Course


class Begun(NamedTuple):
    """What is left of a course, and a START record (`rtcore.program.play`) within its first segment."""

    course: Course
    start: Any


class Hold(NamedTuple):
    """A program was held at one of its ticks, and stood still for so many."""

    tick: int
    still_ticks: int


def begun_at(nodes: Sequence[Node], first: int, holds: Iterable[Hold] = ()) -> Begun:
    """The course of nodes from a tick on; of samples, only those that are still to be played.

    Oscillators ran on during the `holds` before it.
    """
    place, origin = Place(AT_REST, 0, tuple(nodes)), 0
    for hold in holds:
        place = _held(_sought(place, hold.tick - origin), hold.still_ticks)
        origin = hold.tick - place.tick
    place = _sought(place, first - origin)
    if not place.rest:
        return Begun(course_of([]), _start(place, 0))
    piece, *others = place.rest
    if not isinstance(piece, Piece) or piece.track is None:
        return Begun(course_of([place.rest]), _start(place, 0))
    gone = min(math.floor(place.tick * RIG.period_s * piece.rate_per_s), piece.times - 2)
    cut = replace(piece, track=replace(piece.track, begin=gone))
    return Begun(course_of([[cut, *others]]), _start(place, gone))


def _sought(place: Place, tick: int) -> Place:
    """The place of a tick, counted from the beginning of another place's first node."""
    return seek(place.rest, tick, place.state)


def _held(place: Place, still_ticks: int) -> Place:
    """The place after a hold: where a sine is swinging, its phase is another one."""
    piece = place.rest[0] if place.rest else None
    if not isinstance(piece, Piece) or piece.kind not in SWINGING:
        return place
    turned = _frequency_hz(piece, place) * still_ticks * RIG.period_s
    if piece.continues:
        phase = (place.state.phase_cycles + turned) % 1.0
        return replace(place, state=replace(place.state, phase_cycles=phase))
    moved = replace(piece, phase_cycles=(piece.phase_cycles + turned) % 1.0)
    return replace(place, rest=(moved, *place.rest[1:]))


def _frequency_hz(piece: Piece, place: Place) -> float:
    """Of a swinging piece at a place within it; it moves linearly or, in a sweep, by equal ratios."""
    end_hz = piece.frequency_to_hz
    began_hz = place.state.frequency_hz if piece.continues else piece.frequency_from_hz
    began_hz, share = began_hz or end_hz, place.tick / max(1, piece.ticks)
    if piece.kind == Segment.SWEEP:
        return float(began_hz * (end_hz / began_hz) ** share)
    return began_hz + share * (end_hz - began_hz)


def _start(place: Place, knots_before: int) -> Any:
    state = place.state
    values = (state.value, state.mean, state.amplitude, state.frequency_hz, state.phase_cycles)
    return (*values, place.tick, knots_before)
