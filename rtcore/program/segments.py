"""The load program: a table of segments that the setpoint generator walks through.

A segment picks the setpoint up where the one before left it. A jump is a `SMOOTH` segment of no duration, which is
what a step is; else only a harmonic that is told where to begin can jump, and the app leads in to that.

Segments and knots lie in rings. A program that fits is there whole before it starts; a longer one is streamed: the
app overwrites what has been played (`rtcore.program.stream`). Knots are always played in the order of the stream.
"""

from enum import IntEnum

import numpy as np

MAX_SEGMENTS = 4096  # a power of two, as is
MAX_KNOTS = 1 << 16  # 16 s at 4 kHz
MAX_DEPTH = 8  # repeats within repeats


class Segment(IntEnum):
    """What a segment does with the setpoint."""

    END = 0  # the program is over; the setpoint stays
    HOLD = 1  # stay where it is
    LINEAR = 2  # to `target` in `ticks`, or at `rate_per_s` where ticks is 0
    SMOOTH = 3  # to `target` along half a cosine in `ticks`; a step where ticks is 0
    HARMONIC = 4  # mean, amplitude and frequency move from their first to their second values
    REPEAT = 5  # back to segment `jump`, `times` passes in all
    SWEEP = 7  # as HARMONIC, but the frequency moves exponentially: so many octaves a second
    SAMPLES = 8  # plays `times` knots at `rate_per_s`, a cubic between each two


class Branch(IntEnum):
    """What the kinematic compensation does during a segment."""

    EXCLUDED = 0
    WITHOUT_NOTCH = 1
    WITH_NOTCH = 2


SEGMENT = np.dtype(
    [
        ("kind", "i4"),
        ("block", "i2"),  # block of the test that this segment serves
        ("branch", "i2"),  # Branch
        ("continues", "i2"),  # harmonic: 1 picks up mean, amplitude, frequency and phase
        ("counts", "i2"),  # harmonic: 1 where its cycles are data, 0 while it tapers
        ("jump", "i4"),
        ("times", "i8"),
        ("ticks", "i8"),
        ("target", "f8"),  # N or m
        ("rate_per_s", "f8"),  # N/s or m/s; of samples: knots a second
        ("mean_from", "f8"),  # NaN: the setpoint as it is
        ("mean_to", "f8"),  # of samples: what a hold fades to, NaN where it stays
        ("amplitude_from", "f8"),
        ("amplitude_to", "f8"),
        ("frequency_from_hz", "f8"),
        ("frequency_to_hz", "f8"),
        ("phase_cycles", "f8"),  # where a harmonic starts that does not continue
    ],
    align=True,
)

KNOT = np.dtype([("value", "f8"), ("slope", "f8")])  # N or m; its change per knot interval

TABLE = np.dtype(
    [
        ("count", "i8"),  # segments given so far
        ("knot_count", "i8"),  # knots given so far
        ("streamed", "i8"),  # 1: more segments may follow, and none repeats
        ("segments", SEGMENT, (MAX_SEGMENTS,)),
        ("knots", KNOT, (MAX_KNOTS,)),
    ],
    align=True,
)
PROGRAM = np.dtype([("force", TABLE), ("motion", TABLE)], align=True)
