"""Where a course is at a tick, however far into it: found in closed form, loops not turned and pieces not played."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from app.definitions.extent import AT_REST, State, Survey
from app.definitions.pieces import Loop, Node, Piece


@dataclass(frozen=True)
class Place:
    """The setpoint at the beginning of the first node of `rest`, and how far into that the tick is."""

    state: State
    tick: int  # within the first node of `rest`, which is a piece
    rest: tuple[Node, ...]


def seek(nodes: Sequence[Node], tick: int, state: State = AT_REST) -> Place:
    """The place of a tick in nodes that begin at a setpoint; beyond their end nothing is left."""
    for i, node in enumerate(nodes):
        survey = Survey(state)
        ticks = survey.measure([node]).ticks
        if tick < ticks:
            after = tuple(nodes[i + 1 :])
            if isinstance(node, Piece):
                return Place(state, tick, (node, *after))
            found = _within(node, tick, state)
            return replace(found, rest=found.rest + after)
        tick, state = tick - ticks, survey.state
    return Place(state, 0, ())


def _within(loop: Loop, tick: int, state: State) -> Place:
    """The place within a loop: its first pass may begin elsewhere, those after it are alike."""
    survey = Survey(state)
    first = survey.measure(loop.body).ticks
    if tick < first:
        return _with_passes(seek(loop.body, tick, state), loop, loop.times - 1)
    second = survey.state
    each = survey.measure(loop.body).ticks
    passes, tick = divmod(tick - first, each)
    # A harmonic that goes on from pass to pass gains the same phase in each.
    gained = survey.state.phase_cycles - second.phase_cycles
    begun = replace(second, phase_cycles=(second.phase_cycles + passes * gained) % 1.0)
    return _with_passes(seek(loop.body, tick, begun), loop, loop.times - 2 - passes)


def _with_passes(place: Place, loop: Loop, times: int) -> Place:
    """The rest of a pass, and the passes still to come."""
    to_come = (Loop(times, loop.body, loop.origin),) if times > 0 else ()
    return replace(place, rest=place.rest + to_come)
