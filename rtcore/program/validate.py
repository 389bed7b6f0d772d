"""The loop's own check of a program before it adopts it: a table that could lead the generator astray is refused."""

import math

from rtcore.compiled import Record, kernel
from rtcore.program.segments import MAX_DEPTH, MAX_KNOTS, MAX_SEGMENTS, Segment

ROUNDING = 1.0 + 1e-9
SLOWEST_1_S, FASTEST_1_S = 1e-6, 1e4  # rates of a ramp, as shares of the limit


@kernel
def table_is_bounded(table: Record) -> bool:
    """Whether what is there lies within the bank and, where nothing is to follow, has an END."""
    if table.count < 1 or table.count > MAX_SEGMENTS:
        return False
    if table.knot_count < 0 or table.knot_count > MAX_KNOTS:
        return False
    if table.streamed != 0:
        return True
    return table.segments[table.count - 1].kind == Segment.END


@kernel
def repeat_is_too_deep(table: Record, index: int) -> bool:
    """Whether the REPEAT at `index` lies within so many others that the generator could not count them."""
    enclosing = 0
    for outer in range(index + 1, table.count):
        s = table.segments[outer]
        if s.kind == Segment.REPEAT and s.jump <= index:
            enclosing += 1
            if enclosing >= MAX_DEPTH:
                return True
    return False


@kernel
def _within(value: float, limit: float) -> bool:
    return abs(value) <= limit


@kernel
def segment_is_valid(s: Record, index: int, limit: float, frequency_limit_hz: float) -> bool:
    """Whether one segment keeps within the limits (N or m, Hz) and jumps only backwards."""
    if s.ticks < 0:
        return False
    if s.kind == Segment.REPEAT:
        return 0 <= s.jump < index and s.times >= 1
    if s.kind == Segment.SAMPLES:
        return s.ticks >= 1 and s.times >= 2 and 0.0 < s.rate_per_s <= 2.0 * frequency_limit_hz
    if s.kind == Segment.HARMONIC or s.kind == Segment.SWEEP:
        if s.ticks < 1 or not (0.0 < s.frequency_to_hz < frequency_limit_hz):
            return False
        if not _within(abs(s.mean_to) + abs(s.amplitude_to), limit):
            return False
        if s.continues != 0:
            return True
        unknown = (
            limit if s.amplitude_from != 0.0 else 0.0
        )  # the setpoint as it is, up to the limit
        mean = unknown if math.isnan(s.mean_from) else s.mean_from
        started = 0.0 < s.frequency_from_hz < frequency_limit_hz and math.isfinite(s.phase_cycles)
        return started and _within(abs(mean) + abs(s.amplitude_from), limit)
    if s.kind in (Segment.HOLD, Segment.END):
        return True
    if s.kind != Segment.LINEAR and s.kind != Segment.SMOOTH:
        return False
    if (
        s.kind == Segment.LINEAR
        and s.ticks == 0
        and not (SLOWEST_1_S * limit <= s.rate_per_s <= FASTEST_1_S * limit)
    ):
        return False
    return _within(s.target, limit)


@kernel
def is_played_once(program: Record) -> bool:
    """Whether a program is streamed, or has knots: what has been played is overwritten."""
    force, motion = program.force, program.motion
    return force.streamed + motion.streamed + force.knot_count + motion.knot_count > 0


@kernel
def plays_within(g: Record, table: Record, limit: float, frequency_limit_hz: float) -> bool:
    """Whether the setpoint, and the streamed segment that it comes from, keep within the limits."""
    if not abs(g.value) <= limit * ROUNDING:
        return False
    if table.streamed == 0:
        return True
    s = table.segments[g.segment & (MAX_SEGMENTS - 1)]
    return segment_is_valid(s, g.segment, limit, frequency_limit_hz)
