"""How each kind of block or motion is made of pieces, the same for force (N) and motion (m)."""

import math
from collections.abc import Sequence
from dataclasses import replace

from app.definitions.limits import RIG
from app.definitions.pieces import STEEPEST, Loop, Node, Piece, Sine, Track, whole_ticks
from rtcore.program.segments import Segment

LEAD_IN_S = 0.1
BLEND_CYCLES = 2.0  # of the slower of two sines, from one to the other


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
    return _swung(sine, _steady(sine, duration_s, counts=1), phase_deg, taper_cycles, lead_s)


def sweep(
    first: Sine, to_hz: float, duration_s: float, taper_cycles: float, lead_s: float, *, log: bool
) -> list[Node]:
    """Taper in at the first frequency, move to the other in `duration_s`, taper out there."""
    last = replace(first, frequency_hz=to_hz)
    moving = _steady(last, duration_s, counts=1)
    moving = replace(moving, kind=Segment.SWEEP if log else Segment.HARMONIC)
    return _swung(first, moving, 0.0, taper_cycles, lead_s)


def stepped(
    points: Sequence[tuple[Sine, float]],
    last_hz: float,
    settle_cycles: int,
    measure_cycles: int,
    shortest_s: float,
) -> list[Node]:
    """Sine after sine: blended into, settled, and counted; the last tapers out.

    With each is the slowest frequency, its own or of what may be played before it; `last_hz` is that before
    the end.
    """
    nodes: list[Node] = []
    for sine, slower_hz in points:
        hz = sine.frequency_hz
        nodes.append(_steady(sine, _blend_s(slower_hz, shortest_s), counts=0))
        if settle_cycles:
            nodes.append(_steady(sine, settle_cycles / hz, counts=0))
        nodes.append(_steady(sine, measure_cycles / hz, counts=1))
    last, _ = points[-1]
    return [*nodes, _taper_out(last, whole_ticks(_blend_s(last_hz, shortest_s)))]


def course(track: Track, repeats: int, lead_s: float) -> list[Node]:
    """Lead in to the first sample, then play; led back between repeats where the ends differ."""
    lead_in = Piece(Segment.SMOOTH, whole_ticks(lead_s), target=track.first)
    playing = _playing(track)
    if track.first == track.last or repeats == 1:
        return [lead_in, Loop(repeats, (playing,)) if repeats > 1 else playing]
    return [Loop(repeats, (lead_in, playing))]


def _playing(track: Track) -> Piece:
    knots, rate_hz = track.history.statistics.samples, track.history.rate_hz
    ticks = math.ceil((knots - 1) / (rate_hz * RIG.period_s) - 1e-9)
    return Piece(
        Segment.SAMPLES,
        ticks,
        target=track.last,
        rate_per_s=rate_hz,
        mean_to=track.held,
        times=knots,
        track=track,
    )


def _blend_s(slower_hz: float, shortest_s: float) -> float:
    """How long one sine takes to become another."""
    return max(BLEND_CYCLES / slower_hz, shortest_s)


def _swung(
    first: Sine, swing: Piece, phase_deg: float, taper_cycles: float, lead_s: float
) -> list[Node]:
    """A swing that begins as one sine, with what leads into it and out of it."""
    phase_cycles = phase_deg / 360
    if taper_cycles == 0:
        value = first.mean + first.amplitude * math.sin(2 * math.pi * phase_cycles)
        lead_in = Piece(Segment.SMOOTH, whole_ticks(lead_s), target=value)
        return [lead_in, _started(swing, first, phase_cycles)]
    ticks = whole_ticks(taper_cycles / first.frequency_hz)
    turned = first.frequency_hz * ticks * RIG.period_s
    taper_in = Piece(
        Segment.HARMONIC,
        ticks,
        mean_from=math.nan,
        mean_to=first.mean,
        amplitude_to=first.amplitude,
        frequency_from_hz=first.frequency_hz,
        frequency_to_hz=first.frequency_hz,
        phase_cycles=(phase_cycles - turned) % 1.0,
    )
    last = replace(first, frequency_hz=swing.frequency_to_hz)
    ticks_out = whole_ticks(taper_cycles / last.frequency_hz)
    return [taper_in, swing, _taper_out(last, ticks_out)]


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
        asked=sine.asked,
    )


def _started(swing: Piece, first: Sine, phase_cycles: float) -> Piece:
    """A swing that begins by itself, at a phase, instead of continuing."""
    return replace(
        swing,
        mean_from=first.mean,
        amplitude_from=first.amplitude,
        frequency_from_hz=first.frequency_hz,
        phase_cycles=phase_cycles % 1.0,
        continues=0,
    )


def _taper_out(sine: Sine, ticks: int) -> Piece:
    return Piece(
        Segment.HARMONIC,
        ticks,
        mean_to=sine.mean,
        frequency_to_hz=sine.frequency_hz,
        continues=1,
    )
