"""Which ticks of a test's program are data: counted cycles, and steps."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from app.analysis.evidence import Kind, Sine, StepWindow, Stretch, Windows
from app.definitions.definition import Definition
from app.definitions.extent import AT_REST, State, after, cycles_of, ticks_of
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Node, Piece, unrolled
from rtcore.program.segments import Segment


class _Played(NamedTuple):
    piece: Piece
    before: State
    after: State
    first: int  # tick
    last: int  # one past


def windows(definition: Definition, at_most_ticks: int) -> Windows:
    """The windows of a definition's force program, as far as a run of so many ticks gets."""
    blocks = force_nodes(definition.blocks, definition.controller.compensation)
    cycles: list[tuple[int, int]] = []
    steps: list[StepWindow] = []
    step: _Played | None = None
    end = 0
    for played in _play(node for nodes in blocks for node in nodes):
        if played.first >= at_most_ticks:
            break
        end = played.last
        if step is not None:
            begin_n, end_n = step.before.value, step.after.value
            steps.append(StepWindow(step.first, played.last, begin_n, end_n))
        step = played if played.piece.is_step else None
        if played.piece.counts:
            cycles.append((played.first, played.last))
    return Windows(end, tuple(cycles), tuple(steps))


def stretches(definition: Definition) -> Iterator[Stretch]:
    """The whole force program in playing order, lazily; a step and what follows it are one."""
    return _stretches(force_nodes(definition.blocks, definition.controller.compensation))


def motion_stretches(definition: Definition) -> Iterator[Stretch]:
    """The same of the motion: what is in N there is in m here, and blocks are motions."""
    return _stretches(motion_nodes(definition.motion))


def _stretches(blocks: Iterable[Iterable[Node]]) -> Iterator[Stretch]:
    step: _Played | None = None
    for played in _play(node for nodes in blocks for node in nodes):
        if played.piece.is_step:
            step = played
        elif step is not None:
            yield _stretch(step, step.first, played.last, Kind.STEP, played.after)
            step = None
        else:
            yield _stretch(played, played.first, played.last, _kind(played), played.after)


def _kind(played: _Played) -> Kind:
    piece, before = played.piece, played.before
    if piece.counts:
        continued = before.frequency_hz or piece.frequency_to_hz
        began_hz = continued if piece.continues else piece.frequency_from_hz
        return Kind.CYCLES if began_hz == piece.frequency_to_hz else Kind.SWEEP
    leads = piece.kind in (Segment.SMOOTH, Segment.HARMONIC)
    return Kind.LEAD if leads else Kind.COURSE


def _stretch(played: _Played, first: int, last: int, kind: Kind, end: State) -> Stretch:
    piece, before = played.piece, played.before
    steady = Sine(piece.frequency_to_hz, piece.amplitude_to, piece.mean_to, piece.asked)
    return Stretch(
        first,
        last,
        kind,
        piece.origin,
        before.value,
        end.value,
        steady if kind is Kind.CYCLES else None,
        cycles_of(piece, before) if piece.counts else 0,
        bool(piece.continues),
    )


def _play(nodes: Iterable[Node]) -> Iterator[_Played]:
    """Every piece in the order in which the loop carries it out."""
    state, tick = AT_REST, 0
    for piece in unrolled(nodes):
        ticks, end = ticks_of(piece, state), after(piece, state)
        yield _Played(piece, state, end, tick, tick + ticks)
        state, tick = end, tick + ticks
