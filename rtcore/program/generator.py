"""The setpoint generator: walks a table of segments, closed-form within each, continuous between them.

Time within a segment is a whole number of ticks and phase is computed from it, never accumulated, so nothing
drifts. Holding freezes that time and fades the harmonic part to its mean, while the oscillator runs on; so a hold
costs no cycle, counts none that was faded, and resumes by fading in again. Stopping fades everything to zero.
Where a streamed program has not come in time, the setpoint stays, and `starved` says so.
"""

import math

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.program.segments import MAX_DEPTH, MAX_SEGMENTS, Branch, Segment
from rtcore.program.waves import (
    between_knots,
    fade,
    has_phase,
    interval,
    phase_cycles,
    sine_frequency_hz,
)

GENERATOR = np.dtype(
    [
        # where it is
        ("segment", "i8"),
        ("tick", "i8"),  # within the segment
        ("ticks", "i8"),  # of the segment
        ("first_position", "i8"),  # ticks of the program before the segment
        ("depth", "i8"),
        ("repeat_segment", "i8", (MAX_DEPTH,)),
        ("repeat_pass", "i8", (MAX_DEPTH,)),
        ("ended", "i8"),
        # what there is of a streamed program
        ("segments_ready", "i8"),
        ("knots_ready", "i8"),
        ("first_knot", "i8"),  # of the segment
        ("knot", "i8"),  # the first that is still needed
        ("starved", "i8"),
        # how the segment began
        ("from_value", "f8"),
        ("from_mean", "f8"),
        ("from_amplitude", "f8"),
        ("from_frequency_hz", "f8"),
        ("from_phase", "f8"),  # cycles, 0…1
        ("cycles_before", "i8"),  # counted in this block, before this segment
        # fading
        ("hold_ticks", "i8"),  # 0 running … hold_fade_ticks held
        ("stop_ticks", "i8"),
        # what it gives
        ("value", "f8"),  # N or m
        ("mean", "f8"),
        ("amplitude", "f8"),
        ("frequency_hz", "f8"),  # of the load, 0 where there is none
        ("branch", "i8"),
        ("block", "i8"),
        ("cycle", "i8"),
        (
            "position",
            "i8",
        ),  # in ticks of the program: stands still in a hold, jumps where segments are skipped
    ],
    align=True,
)

MOST_SEGMENTS_A_TICK = 64  # a table whose segments take no time cannot keep the tick
_SEGMENT_MASK = MAX_SEGMENTS - 1


@kernel
def start(g: Record, table: Record, value: float, period_s: float) -> None:
    """Begin a table at a setpoint of `value`."""
    g.segment = 0
    g.first_position = 0
    g.position = 0
    g.depth = 0
    g.ended = 0
    g.hold_ticks = 0
    g.stop_ticks = 0
    g.cycles_before = 0
    g.block = -1
    g.segments_ready = table.count
    g.knots_ready = table.knot_count
    g.knot = 0
    g.starved = 0
    rest(g, value)
    enter(g, table.segments[0], period_s)


@kernel
def rest(g: Record, value: float) -> None:
    """No harmonic, setpoint at `value`."""
    g.value = value
    g.mean = value
    g.amplitude = 0.0
    g.frequency_hz = 0.0
    g.from_phase = 0.0
    g.branch = Branch.EXCLUDED


@kernel
def enter(g: Record, s: Record, period_s: float) -> None:
    """Fix how the segment begins and how long it takes."""
    g.tick = 0
    g.ticks = s.ticks
    g.from_value = g.value
    if s.block != g.block and s.kind != Segment.END and s.kind != Segment.REPEAT:
        g.cycles_before = 0
        g.cycle = 0
        g.block = s.block
    g.branch = s.branch
    if s.kind == Segment.LINEAR and s.ticks == 0:
        g.ticks = math.ceil(abs(s.target - g.value) / (s.rate_per_s * period_s) - 1e-9)
    g.first_knot = g.knot
    if has_phase(s.kind):
        if s.continues != 0:
            g.from_mean = g.mean
            g.from_amplitude = g.amplitude
            g.from_frequency_hz = g.frequency_hz if g.frequency_hz > 0.0 else s.frequency_to_hz
        else:
            g.from_mean = g.value if math.isnan(s.mean_from) else s.mean_from
            g.from_amplitude = s.amplitude_from
            g.from_frequency_hz = s.frequency_from_hz
            g.from_phase = s.phase_cycles


@kernel
def evaluate(g: Record, s: Record, table: Record, tick: int, period_s: float) -> None:
    """Set mean, amplitude, frequency and value at a tick of the segment."""
    share = tick / g.ticks if g.ticks > 0 else 1.0
    if has_phase(s.kind):
        blend = 1.0 - fade(tick, g.ticks)
        g.mean = g.from_mean + blend * (s.mean_to - g.from_mean)
        g.amplitude = g.from_amplitude + blend * (s.amplitude_to - g.from_amplitude)
        g.frequency_hz = sine_frequency_hz(g, s, tick)
        phase = phase_cycles(g, s, tick, period_s)
        g.value = g.mean + g.amplitude * math.sin(2.0 * math.pi * (phase - math.floor(phase)))
        return
    target = s.target
    if s.kind in (Segment.HOLD, Segment.END, Segment.REPEAT):
        rest(g, g.from_value)
    elif s.kind == Segment.LINEAR:
        rest(g, g.from_value + share * (target - g.from_value))
    elif s.kind == Segment.SAMPLES:
        rest(g, between_knots(g, s, table, tick, period_s))
        g.mean = g.value if math.isnan(s.mean_to) else s.mean_to
    else:
        blend = 1.0 - fade(tick, g.ticks) if g.ticks > 0 else 1.0
        rest(g, g.from_value + blend * (target - g.from_value))
    g.branch = s.branch


@kernel
def leave_sine(g: Record, s: Record, tick: int, period_s: float) -> None:
    """Count the cycles of a sine that ends at a tick, and keep its phase for what continues."""
    phase = phase_cycles(g, s, tick, period_s)
    if s.counts != 0:
        half_a_tick = 0.5 * g.frequency_hz * period_s  # a cycle may end between ticks
        g.cycles_before += math.floor(phase - g.from_phase + half_a_tick + 1e-9)
    g.from_phase = phase - math.floor(phase)


@kernel
def _leave(g: Record, s: Record, table: Record, period_s: float) -> None:
    """Set what the segment leaves behind: its value, phase and cycles at its last instant."""
    evaluate(g, s, table, g.ticks, period_s)
    g.first_position += g.ticks
    if s.kind == Segment.SAMPLES:
        g.knot = g.first_knot + s.times
        g.mean = g.value  # a sine that continues from here begins where the samples end
    if has_phase(s.kind):
        leave_sine(g, s, g.ticks, period_s)


@kernel
def _after_repeat(g: Record, s: Record) -> int:
    """The segment that follows a REPEAT: back to its body, or on."""
    top = g.depth - 1
    if top >= 0 and g.repeat_segment[top] == g.segment:
        g.repeat_pass[top] += 1
    elif g.depth == MAX_DEPTH:  # no valid table gets here
        return g.segment + 1
    else:
        top += 1
        g.depth = top + 1
        g.repeat_segment[top] = g.segment
        g.repeat_pass[top] = 1
    if g.repeat_pass[top] < s.times:
        return s.jump
    g.depth = top
    return g.segment + 1


@kernel
def _settle(g: Record, table: Record, period_s: float) -> None:
    """Go on to the segment that this tick belongs to, as far as the program has come."""
    for _ in range(MOST_SEGMENTS_A_TICK):
        s = table.segments[g.segment & _SEGMENT_MASK]
        if s.kind == Segment.END:
            g.ended = 1
            return
        if s.kind == Segment.REPEAT:
            if table.streamed != 0:  # what it would go back to is overwritten
                g.starved = 1
                return
            g.segment = _after_repeat(g, s)
        elif g.tick < g.ticks:
            return
        elif g.segment + 1 >= g.segments_ready or not _knots_are_there(g, s, g.ticks, period_s):
            g.starved = 1
            return
        else:
            _leave(g, s, table, period_s)
            g.segment += 1
        enter(g, table.segments[g.segment & _SEGMENT_MASK], period_s)


@kernel
def _knots_are_there(g: Record, s: Record, tick: int, period_s: float) -> bool:
    """Whether a tick of a segment has its knots; marks the first that is still needed."""
    if s.kind != Segment.SAMPLES:
        return True
    g.knot = g.first_knot + interval(g, s, tick, period_s)
    return g.knot + 1 < g.knots_ready


@kernel
def refresh(g: Record, segments_ready: int, knots_ready: int) -> None:
    """Tell the generator how much of a streamed program has come by now."""
    g.segments_ready = segments_ready
    g.knots_ready = knots_ready


@kernel
def generate(
    g: Record,
    table: Record,
    holding: bool,
    stopping: bool,
    hold_fade_ticks: int,
    stop_fade_ticks: int,
    period_s: float,
) -> bool:
    """One tick of setpoint: the result is in `g.value`; True once a stop has faded to zero.

    `holding` and `stopping` are what the mode asks for in this tick.
    """
    if stopping:
        g.stop_ticks += 1
    elif holding:
        g.hold_ticks = min(g.hold_ticks + 1, hold_fade_ticks)
    elif g.hold_ticks > 0:
        g.hold_ticks -= 1

    frozen = stopping or g.hold_ticks > 0
    if not frozen and g.ended == 0:
        _settle(g, table, period_s)
    s = table.segments[g.segment & _SEGMENT_MASK]
    if _knots_are_there(g, s, g.tick, period_s):
        evaluate(g, s, table, g.tick, period_s)
    else:  # the setpoint stays where it is
        g.from_value = g.value if g.starved == 0 else g.from_value
        rest(g, g.from_value)
        g.starved = 1
    g.position = g.first_position + g.tick
    g.cycle = g.cycles_before
    if has_phase(s.kind) and s.counts != 0:
        turned = phase_cycles(g, s, g.tick, period_s) - g.from_phase
        g.cycle += math.floor(turned + 1e-9)
    if g.hold_ticks > 0:
        g.value = g.mean + (g.value - g.mean) * fade(g.hold_ticks, hold_fade_ticks)
    if g.stop_ticks > 0:
        g.value *= fade(min(g.stop_ticks, stop_fade_ticks), stop_fade_ticks)
    if frozen:
        phase = g.from_phase + g.frequency_hz * period_s
        g.from_phase = phase - math.floor(phase)
    elif g.ended == 0 and g.starved == 0:
        g.tick += 1
    return g.stop_ticks >= stop_fade_ticks
