"""What blocks and motions are made of: pieces, each a segment of the loop's program, and loops.

The same for force (N) and motion (m): only lead-in and limits differ.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from app.definitions.limits import RIG
from app.documents.tree import Path
from rtcore.program.segments import Branch, Segment

LEAD_IN_S = 0.1
STEEPEST = math.pi / 2  # slope of half a cosine in its middle, over its mean slope


@dataclass(frozen=True, slots=True)
class Piece:
    """One segment; the fields that `SEGMENT` has bear its names."""

    kind: Segment
    ticks: int = 0
    target: float = 0.0
    rate_per_s: float = 0.0
    mean_from: float = 0.0
    mean_to: float = 0.0
    amplitude_from: float = 0.0
    amplitude_to: float = 0.0
    frequency_from_hz: float = 0.0
    frequency_to_hz: float = 0.0
    phase_cycles: float = 0.0
    continues: int = 0
    counts: int = 0
    branch: Branch = Branch.EXCLUDED
    is_step: bool = False  # meant to be sudden
    origin: Path = ()  # the block it serves: ("blocks", 1, "blocks", 0)


@dataclass(frozen=True, slots=True)
class Loop:
    """Nodes, so many times in all."""

    times: int
    body: tuple["Node", ...]
    origin: Path = ()


Node = Piece | Loop


@dataclass(frozen=True, slots=True)
class Sine:
    """A harmonic in full swing: `mean` and `amplitude` in N or m."""

    mean: float
    amplitude: float
    frequency_hz: float


def whole_ticks(duration_s: float) -> int:
    """The nearest whole number of ticks, at least 1."""
    return max(1, math.floor(duration_s / RIG.period_s + 0.5))


def lead_in_s(limit: float, rate_limit_per_s: float) -> float:
    """Long enough to lead from any setpoint to any other (±limit) below the rate limit."""
    return max(LEAD_IN_S, STEEPEST * 2 * limit / rate_limit_per_s)


def hold(target: float | None, duration_s: float, lead_s: float) -> list[Node]:
    """Go to the target smoothly and stay; None stays where the setpoint is."""
    stay = Piece(Segment.HOLD, whole_ticks(duration_s))
    if target is None:
        return [stay]
    return [Piece(Segment.SMOOTH, whole_ticks(lead_s), target=target), stay]


def ramp(target: float, rate_per_s: float | None, duration_s: float | None) -> list[Node]:
    """In a straight line to the target."""
    if duration_s is not None:
        return [Piece(Segment.LINEAR, whole_ticks(duration_s), target=target)]
    return [Piece(Segment.LINEAR, target=target, rate_per_s=rate_per_s or 0.0)]


def step(target: float, rise_s: float, hold_s: float, *, is_step: bool) -> list[Node]:
    """To the target at once or within the rise time, then stay."""
    ticks = whole_ticks(rise_s) if rise_s > 0 else 0
    rise = Piece(Segment.SMOOTH, ticks, target=target, is_step=is_step)
    return [rise, Piece(Segment.HOLD, whole_ticks(hold_s))]


def harmonic(
    sine: Sine, duration_s: float, phase_deg: float, taper_cycles: float, lead_s: float
) -> list[Node]:
    """Taper in, full amplitude for `duration_s`, taper out; without tapers a lead-in instead."""
    phase_cycles = phase_deg / 360
    steady = _steady(sine, duration_s, counts=1)
    if taper_cycles == 0:
        first = sine.mean + sine.amplitude * math.sin(2 * math.pi * phase_cycles)
        lead_in = Piece(Segment.SMOOTH, whole_ticks(lead_s), target=first)
        return [lead_in, _started(steady, sine, phase_cycles)]
    ticks = whole_ticks(taper_cycles / sine.frequency_hz)
    turned = sine.frequency_hz * ticks * RIG.period_s
    taper_in = Piece(
        Segment.HARMONIC,
        ticks,
        mean_from=math.nan,
        mean_to=sine.mean,
        amplitude_to=sine.amplitude,
        frequency_from_hz=sine.frequency_hz,
        frequency_to_hz=sine.frequency_hz,
        phase_cycles=(phase_cycles - turned) % 1.0,
    )
    return [taper_in, steady, _taper_out(sine, ticks)]


def layers(sines: Sequence[tuple[Sine, float]], repeats: int, transition_s: float) -> list[Node]:
    """Layer after layer (each a sine and its duration in s), each blended into the next."""
    body: list[Node] = []
    for sine, duration_s in sines:
        body.append(_steady(sine, transition_s, counts=0))
        body.append(_steady(sine, duration_s, counts=1))
    last = sines[-1][0]
    return [Loop(repeats, tuple(body)), _taper_out(last, whole_ticks(transition_s))]


def _steady(sine: Sine, duration_s: float, counts: int) -> Piece:
    """From whatever harmonic there is to this one, or on with this one."""
    return Piece(
        Segment.HARMONIC,
        whole_ticks(duration_s),
        mean_to=sine.mean,
        amplitude_to=sine.amplitude,
        frequency_to_hz=sine.frequency_hz,
        continues=1,
        counts=counts,
    )


def _started(steady: Piece, sine: Sine, phase_cycles: float) -> Piece:
    """A steady piece that begins by itself, at a phase, instead of continuing."""
    return Piece(
        steady.kind,
        steady.ticks,
        mean_from=sine.mean,
        mean_to=sine.mean,
        amplitude_from=sine.amplitude,
        amplitude_to=sine.amplitude,
        frequency_from_hz=sine.frequency_hz,
        frequency_to_hz=sine.frequency_hz,
        phase_cycles=phase_cycles % 1.0,
        counts=steady.counts,
    )


def _taper_out(sine: Sine, ticks: int) -> Piece:
    return Piece(
        Segment.HARMONIC,
        ticks,
        mean_to=sine.mean,
        frequency_to_hz=sine.frequency_hz,
        continues=1,
    )
