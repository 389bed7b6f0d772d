"""What the conductor reads: every sine of an adaptive frequency response, when and in which segment it is played."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import chain

from app.definitions.definition import Definition
from app.definitions.expansion import segments_in
from app.definitions.extent import Survey
from app.definitions.nodes import force_nodes
from app.definitions.pieces import Node, Piece
from app.definitions.response_points import PlannedPoint, planned_points
from app.definitions.responses import FrequencyResponse
from rtcore.program.segments import MAX_SEGMENTS


class Role(Enum):
    """What a segment does for its point."""

    BLEND = "blend"
    SETTLE = "settle"
    MEASURE = "measure"
    OUT = "out"  # the taper after the last


@dataclass(frozen=True)
class Turn:
    """A segment of the force course: ticks of the program from `first` to before `last`.

    `point` counts the points of its score; of OUT it is one past the last.
    """

    first: int
    last: int
    segment: int
    role: Role
    point: int


@dataclass(frozen=True)
class Score:
    """An adaptive frequency response: its points, and its turns in playing order."""

    block: int
    asked: FrequencyResponse
    points: Sequence[PlannedPoint]
    turns: Sequence[Turn]

    def segment_of(self, point: int, role: Role) -> int:
        """Where a point is blended into, settled or measured; one past the last point is the taper."""
        for turn in self._of_point(point):
            if turn.role in (role, Role.OUT):
                return turn.segment
        raise ValueError(f"point {point} has no {role.value}")

    def _of_point(self, point: int) -> Sequence[Turn]:
        each = (len(self.turns) - 1) // len(self.points)
        return self.turns[point * each : (point + 1) * each]


def scores_of(definition: Definition) -> list[Score]:
    """Of every frequency response that adapts, in playing order."""
    blocks = force_nodes(definition.blocks, definition.controller.compensation)
    repeats_stay = segments_in(chain.from_iterable(blocks)) < MAX_SEGMENTS
    survey, tick, segment = Survey(), 0, 0
    found = []
    for number, (block, nodes) in enumerate(zip(definition.blocks, blocks, strict=True)):
        if isinstance(block, FrequencyResponse) and block.is_adaptive:
            turns = list(_turns(nodes, tick, segment))
            found.append(Score(number, block, planned_points(block), turns))
        tick += survey.measure(nodes).ticks
        segment += segments_in(nodes) if repeats_stay else _unrolled(nodes)
    return found


def _turns(nodes: Sequence[Node], tick: int, segment: int) -> Iterator[Turn]:
    point, before = 0, Role.MEASURE
    for piece in nodes:
        assert isinstance(piece, Piece)  # stepped sines have no loops
        role = _role(piece, before)
        yield Turn(tick, tick + piece.ticks, segment, role, point)
        point += role is Role.MEASURE
        tick, segment, before = tick + piece.ticks, segment + 1, role


def _role(piece: Piece, before: Role) -> Role:
    if piece.counts:
        return Role.MEASURE
    if piece.amplitude_to == 0.0:
        return Role.OUT
    return Role.BLEND if before is Role.MEASURE else Role.SETTLE


def _unrolled(nodes: Sequence[Node]) -> int:
    """Segments, each pass of a loop counted."""
    return sum(1 if isinstance(n, Piece) else n.times * _unrolled(n.body) for n in nodes)
