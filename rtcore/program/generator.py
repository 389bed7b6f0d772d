"""The setpoint generator: walks a table of segments, closed-form within each, continuous between them.

Time within a segment is a whole number of ticks and phase is computed from it, never accumulated, so nothing
drifts. Holding freezes that time and fades the harmonic part to its mean, while the oscillator runs on; so a hold
costs no cycle, counts none that was faded, and resumes by fading in again. Stopping fades everything to zero.
"""

import math

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.program.segments import MAX_DEPTH, Branch, Segment

GENERATOR = np.dtype(
    [
        # where it is
        ("segment", "i8"),
        ("tick", "i8"),  # within the segment
        ("ticks", "i8"),  # of the segment
        ("depth", "i8"),
        ("repeat_segment", "i8", (MAX_DEPTH,)),
        ("repeat_pass", "i8", (MAX_DEPTH,)),
        ("ended", "i8"),
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
    ],
    align=True,
)

MOST_SEGMENTS_A_TICK = 64  # a table whose segments take no time cannot keep the tick


@kernel
def fade(ticks: int, of_ticks: int) -> float:
    """Half a cosine from 1 at 0 to 0 at `of_ticks`."""
    return 0.5 + 0.5 * math.cos(math.pi * ticks / of_ticks)


@kernel
def start(g: Record, table: Record, value: float, period_s: float) -> None:
    """Begin a table at a setpoint of `value`."""
    g.segment = 0
    g.depth = 0
    g.ended = 0
    g.hold_ticks = 0
    g.stop_ticks = 0
    g.cycles_before = 0
    g.block = -1
    rest(g, value)
    _enter(g, table.segments[0], period_s)


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
def _phase(g: Record, s: Record, tick: int, period_s: float) -> float:
    """Phase (cycles) after so many ticks of a harmonic whose frequency moves linearly."""
    t = tick * period_s
    phase = g.from_phase + g.from_frequency_hz * t
    if s.frequency_to_hz != g.from_frequency_hz:
        phase += 0.5 * (s.frequency_to_hz - g.from_frequency_hz) * t * tick / g.ticks
    return phase


@kernel
def _enter(g: Record, s: Record, period_s: float) -> None:
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
    if s.kind == Segment.HARMONIC:
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
def _evaluate(g: Record, s: Record, tick: int, period_s: float) -> None:
    """Set mean, amplitude, frequency and value at a tick of the segment."""
    share = tick / g.ticks if g.ticks > 0 else 1.0
    if s.kind == Segment.HARMONIC:
        blend = 1.0 - fade(tick, g.ticks)
        g.mean = g.from_mean + blend * (s.mean_to - g.from_mean)
        g.amplitude = g.from_amplitude + blend * (s.amplitude_to - g.from_amplitude)
        g.frequency_hz = g.from_frequency_hz + share * (s.frequency_to_hz - g.from_frequency_hz)
        phase = _phase(g, s, tick, period_s)
        g.value = g.mean + g.amplitude * math.sin(2.0 * math.pi * (phase - math.floor(phase)))
        return
    target = s.target
    if s.kind in (Segment.HOLD, Segment.END, Segment.REPEAT):
        rest(g, g.from_value)
    elif s.kind == Segment.LINEAR:
        rest(g, g.from_value + share * (target - g.from_value))
    else:
        blend = 1.0 - fade(tick, g.ticks) if g.ticks > 0 else 1.0
        rest(g, g.from_value + blend * (target - g.from_value))
    g.branch = s.branch


@kernel
def _leave(g: Record, s: Record, period_s: float) -> None:
    """Set what the segment leaves behind: its value, phase and cycles at its last instant."""
    _evaluate(g, s, g.ticks, period_s)
    if s.kind == Segment.HARMONIC:
        phase = _phase(g, s, g.ticks, period_s)
        if s.counts != 0:
            g.cycles_before += math.floor(
                phase - g.from_phase + 0.5 * g.frequency_hz * period_s + 1e-9
            )
        g.from_phase = phase - math.floor(phase)


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
    """Go on to the segment that this tick belongs to."""
    for _ in range(MOST_SEGMENTS_A_TICK):
        s = table.segments[g.segment]
        if s.kind == Segment.END:
            g.ended = 1
            return
        if s.kind == Segment.REPEAT:
            g.segment = _after_repeat(g, s)
        elif g.tick >= g.ticks:
            _leave(g, s, period_s)
            g.segment += 1
        else:
            return
        _enter(g, table.segments[g.segment], period_s)


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
    s = table.segments[g.segment]
    _evaluate(g, s, g.tick, period_s)
    g.cycle = g.cycles_before
    if s.kind == Segment.HARMONIC and s.counts != 0:
        turned = _phase(g, s, g.tick, period_s) - g.from_phase
        g.cycle += math.floor(turned + 1e-9)
    if g.hold_ticks > 0:
        g.value = g.mean + (g.value - g.mean) * fade(g.hold_ticks, hold_fade_ticks)
    if g.stop_ticks > 0:
        g.value *= fade(min(g.stop_ticks, stop_fade_ticks), stop_fade_ticks)
    if frozen:
        phase = g.from_phase + g.frequency_hz * period_s
        g.from_phase = phase - math.floor(phase)
    elif g.ended == 0:
        g.tick += 1
    return g.stop_ticks >= stop_fade_ticks
