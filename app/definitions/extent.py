"""How long pieces and loops last and how far they go, in closed form: no loop is turned.

The first pass of a loop may begin at another setpoint than the passes after it, which are alike;
so two passes tell everything about a million.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from app.definitions.limits import RIG
from app.definitions.pieces import STEEPEST, SWINGING, Loop, Node, Piece
from app.documents.tree import Path
from rtcore.program.segments import Segment


@dataclass(frozen=True, slots=True)
class State:
    """The setpoint between two pieces: N or m, Hz, cycles (0…1). Frequency 0: no harmonic."""

    value: float = 0.0
    mean: float = 0.0
    amplitude: float = 0.0
    frequency_hz: float = 0.0
    phase_cycles: float = 0.0


AT_REST = State()


@dataclass(frozen=True, slots=True)
class Extent:
    """Ticks, counted cycles, least and greatest setpoint (N or m), and the steepest change.

    `steepest_per_s` leaves out steps and a sine's own swing; `steepest_at` is the block it is in.
    """

    ticks: int = 0
    cycles: int = 0
    low: float = math.inf
    high: float = -math.inf
    steepest_per_s: float = 0.0
    steepest_at: Path = ()
    idle_at: Path = ()  # a loop whose pass takes no time

    def then(self, other: "Extent", times: int = 1) -> "Extent":
        """This, and then the other so many times."""
        steeper = self if self.steepest_per_s >= other.steepest_per_s else other
        return Extent(
            self.ticks + times * other.ticks,
            self.cycles + times * other.cycles,
            min(self.low, other.low),
            max(self.high, other.high),
            steeper.steepest_per_s,
            steeper.steepest_at,
            self.idle_at or other.idle_at,
        )


@dataclass
class Survey:
    """Measures nodes one after another; `state` is where the setpoint has got to."""

    state: State = AT_REST
    _known: dict[tuple[int, State], tuple[Extent, State]] = field(default_factory=dict)

    def measure(self, nodes: Iterable[Node]) -> Extent:
        """The extent of nodes that begin at `state`; moves `state` to their end."""
        total = Extent()
        for node in nodes:
            total = total.then(self._piece(node) if isinstance(node, Piece) else self._loop(node))
        return total

    def _piece(self, piece: Piece) -> Extent:
        before, self.state = self.state, after(piece, self.state)
        return _extent(piece, before, self.state)

    def _loop(self, loop: Loop) -> Extent:
        # Loops within loops would be measured 2^depth times without this.
        key = (id(loop), self.state)
        if key not in self._known:
            self._known[key] = (self._passes(loop), self.state)
        extent, self.state = self._known[key]
        return extent

    def _passes(self, loop: Loop) -> Extent:
        first = self.measure(loop.body)
        if loop.times == 1:
            return first
        later = self.measure(loop.body)
        idle = Extent(idle_at=loop.origin) if later.ticks == 0 else Extent()
        return first.then(later, loop.times - 1).then(idle)


def after(piece: Piece, state: State) -> State:
    """Where a piece leaves the setpoint."""
    if piece.kind not in SWINGING:
        value = state.value if piece.kind == Segment.HOLD else piece.target
        return State(value, value)
    phase = state.phase_cycles if piece.continues else piece.phase_cycles
    phase = (phase + _turned(piece, state)) % 1.0
    value = piece.mean_to + piece.amplitude_to * math.sin(2 * math.pi * phase)
    return State(value, piece.mean_to, piece.amplitude_to, piece.frequency_to_hz, phase)


def ticks_of(piece: Piece, state: State) -> int:
    """How long a piece takes from a setpoint; at a rate, to the digit as the generator has it."""
    if piece.kind != Segment.LINEAR or piece.ticks > 0:
        return piece.ticks
    per_tick = piece.rate_per_s * RIG.period_s
    return math.ceil(abs(piece.target - state.value) / per_tick - 1e-9)


def cycles_of(piece: Piece, state: State) -> int:
    """Whole cycles that a harmonic turns from a setpoint."""
    half_a_tick = 0.5 * piece.frequency_to_hz * RIG.period_s  # a whole cycle may end between ticks
    return math.floor(_turned(piece, state) + half_a_tick + 1e-9)


def _turned(piece: Piece, state: State) -> float:
    """Cycles that a harmonic turns while its frequency moves, linearly or by equal ratios."""
    end_hz = piece.frequency_to_hz
    began_hz = (state.frequency_hz if piece.continues else piece.frequency_from_hz) or end_hz
    mean_hz = 0.5 * (began_hz + end_hz)
    if piece.kind == Segment.SWEEP and began_hz != end_hz:
        mean_hz = (end_hz - began_hz) / math.log(end_hz / began_hz)
    return mean_hz * piece.ticks * RIG.period_s


def _extent(piece: Piece, before: State, end: State) -> Extent:
    ticks = ticks_of(piece, before)
    cycles = cycles_of(piece, before) if piece.counts else 0
    mean, amplitude = _began(piece, before)
    if piece.track is not None:  # its steepness is the block's own to answer for
        low, high = piece.track.bounds
        return Extent(ticks, 0, min(low, before.value), max(high, before.value))
    low = min(before.value, end.value, mean - amplitude, end.mean - end.amplitude)
    high = max(before.value, end.value, mean + amplitude, end.mean + end.amplitude)
    rate_per_s = _rate_per_s(piece, end.mean - mean, ticks)
    if piece.kind in SWINGING:
        rate_per_s = max(rate_per_s, _blend_per_s(piece, before, amplitude))
    return Extent(ticks, cycles, low, high, rate_per_s, piece.origin)


def _began(piece: Piece, before: State) -> tuple[float, float]:
    """Mean and amplitude at the beginning of a piece."""
    if piece.kind not in SWINGING:
        return before.value, 0.0
    if piece.continues:
        return before.mean, before.amplitude
    mean = before.value if math.isnan(piece.mean_from) else piece.mean_from
    return mean, piece.amplitude_from


def _rate_per_s(piece: Piece, shift: float, ticks: int) -> float:
    if piece.is_step or ticks == 0:
        return 0.0
    steepest = 1.0 if piece.kind == Segment.LINEAR else STEEPEST
    return steepest * abs(shift) / (ticks * RIG.period_s)


def _blend_per_s(piece: Piece, before: State, amplitude: float) -> float:
    """How fast the amplitude blends, where that is steeper than the sine's own swing; 0 else."""
    blend_per_s = STEEPEST * abs(piece.amplitude_to - amplitude) / (piece.ticks * RIG.period_s)
    began_hz = before.frequency_hz if piece.continues else piece.frequency_from_hz
    fastest_hz = max(began_hz, piece.frequency_to_hz)
    swing_per_s = 2 * math.pi * fastest_hz * max(piece.amplitude_to, amplitude)
    return blend_per_s if blend_per_s > swing_per_s else 0.0
