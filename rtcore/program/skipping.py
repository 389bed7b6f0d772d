"""Skipping: a sine ends before its time and another segment of its chain goes on from there, without a jump.

Where a frequency response needs no more of a point, the app has the loop leave the rest of it out.
"""

from rtcore.compiled import Record, kernel
from rtcore.program.generator import enter, evaluate, leave_sine
from rtcore.program.segments import MAX_SEGMENTS, Segment

MOST_SKIPPED = 1024  # segments that are looked at within one tick
_SEGMENT_MASK = MAX_SEGMENTS - 1


@kernel
def can_skip(g: Record, table: Record, target: int) -> bool:
    """Whether from the present segment to the target, further on, there are only harmonics of one block, and
    each continues the one before it."""
    if not g.segment < target <= g.segment + MOST_SKIPPED or target >= g.segments_ready:
        return False
    now = table.segments[g.segment & _SEGMENT_MASK]
    if now.kind != Segment.HARMONIC or g.ended != 0:
        return False
    for i in range(g.segment + 1, target + 1):
        s = table.segments[i & _SEGMENT_MASK]
        if s.kind != Segment.HARMONIC or s.continues == 0 or s.block != now.block:
            return False
    return True


@kernel
def skip(g: Record, table: Record, target: int, period_s: float) -> int:
    """Begin the target at this tick, where `can_skip`; how many ticks of the program are left out.

    The target picks up mean, amplitude, frequency and phase as they are at this tick, wherever in its
    segment the sine was.
    """
    s = table.segments[g.segment & _SEGMENT_MASK]
    position = g.first_position + g.tick
    evaluate(g, s, table, g.tick, period_s)
    leave_sine(g, s, g.tick, period_s)
    g.first_position += g.ticks
    for i in range(g.segment + 1, target):
        g.first_position += table.segments[i & _SEGMENT_MASK].ticks
    g.segment = target
    enter(g, table.segments[target & _SEGMENT_MASK], period_s)
    return g.first_position - position
