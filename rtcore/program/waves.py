"""The closed forms of the segments: phase and frequency of a sine, and the curve through knots, at any tick.

Each looks at how the segment began, which the generator's record `g` holds, and at the segment `s`.
"""

import math

from rtcore.compiled import Record, kernel
from rtcore.program.segments import MAX_KNOTS, Segment

_KNOT_MASK = MAX_KNOTS - 1


@kernel
def fade(ticks: int, of_ticks: int) -> float:
    """Half a cosine from 1 at 0 to 0 at `of_ticks`."""
    return 0.5 + 0.5 * math.cos(math.pi * ticks / of_ticks)


@kernel
def has_phase(kind: int) -> bool:
    """Whether a segment is a sine: harmonic or sweep."""
    return kind == Segment.HARMONIC or kind == Segment.SWEEP


@kernel
def octave_share(g: Record, s: Record, tick: int) -> float:
    """The exponent that a sweep's frequency has grown by."""
    return math.log(s.frequency_to_hz / g.from_frequency_hz) * tick / g.ticks


@kernel
def phase_cycles(g: Record, s: Record, tick: int, period_s: float) -> float:
    """Phase (cycles) after so many ticks of a sine whose frequency moves, linearly or exponentially."""
    t = tick * period_s
    phase = g.from_phase + g.from_frequency_hz * t
    if s.frequency_to_hz == g.from_frequency_hz or tick == 0:
        return phase
    if s.kind == Segment.SWEEP:
        grown = octave_share(g, s, tick)
        return g.from_phase + g.from_frequency_hz * t * math.expm1(grown) / grown
    return phase + 0.5 * (s.frequency_to_hz - g.from_frequency_hz) * t * tick / g.ticks


@kernel
def sine_frequency_hz(g: Record, s: Record, tick: int) -> float:
    """Frequency at a tick of a sine, Hz."""
    if s.kind == Segment.SWEEP:
        return g.from_frequency_hz * math.exp(octave_share(g, s, tick))
    return g.from_frequency_hz + tick / g.ticks * (s.frequency_to_hz - g.from_frequency_hz)


@kernel
def interval(g: Record, s: Record, tick: int, period_s: float) -> int:
    """Between which two knots of the segment a tick lies: the number of the first."""
    return min(math.floor(tick * period_s * s.rate_per_s + 1e-9), s.times - 2)


@kernel
def between_knots(g: Record, s: Record, table: Record, tick: int, period_s: float) -> float:
    """The cubic through two knots with their slopes (Hermite); the last knot is met exactly."""
    i = interval(g, s, tick, period_s)
    first = g.first_knot + i
    a, b = table.knots[first & _KNOT_MASK], table.knots[(first + 1) & _KNOT_MASK]
    u = min(max(tick * period_s * s.rate_per_s - i, 0.0), 1.0)
    v = 1.0 - u
    ends = v * v * (1.0 + 2.0 * u) * a.value + u * u * (1.0 + 2.0 * v) * b.value
    return ends + u * v * (v * a.slope - u * b.slope)
