"""Plays a program through the loop's own generator, off the clock: least and greatest setpoint of each bin of time.

What a test will do is shown from here; no other code knows the waveform.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Record, address_of, carray, entry, kernel, pointer
from rtcore.program.generator import GENERATOR, MOST_SEGMENTS_A_TICK, enter, generate, start
from rtcore.program.segments import TABLE
from rtcore.program.stream import Course, TableWriter

Records = npt.NDArray[Any]

BIN = np.dtype([("low", "f8"), ("high", "f8"), ("block", "i8")])
TAPE = np.dtype(
    [
        ("tick", "i8"),  # so many have been played
        ("ticks", "i8"),  # so many are wanted
        ("bins", "i8"),
        ("value", "f8"),  # the last; NaN before the first
        ("peak", "f8"),  # the greatest either way, with its sign
        ("peak_tick", "i8"),
        ("steepest", "f8"),  # the greatest change in a tick either way, with its sign
        ("steepest_tick", "i8"),
    ]
)
START = np.dtype(
    [
        ("value", "f8"),
        ("mean", "f8"),
        ("amplitude", "f8"),
        ("frequency_hz", "f8"),
        ("phase_cycles", "f8"),
        ("tick", "i8"),  # of the first segment: those before have gone by
        ("knots_before", "i8"),  # of the first segment that are not given any more
    ]
)
_HOLD_TICKS, _STOP_TICKS = 1000, 2000  # of no account: nothing holds or stops here


@entry
def set_down(g_address: int, table_address: int, start_address: int, period_s: float) -> None:
    """Set the generator down within the first segment, in full swing where there is one."""
    g = carray(pointer(g_address), 1, GENERATOR)[0]
    table = carray(pointer(table_address), 1, TABLE)[0]
    at = carray(pointer(start_address), 1, START)[0]
    start(g, table, at.value, period_s)
    g.mean = at.mean
    g.amplitude = at.amplitude
    g.frequency_hz = at.frequency_hz
    g.from_phase = at.phase_cycles
    enter(g, table.segments[0], period_s)
    g.tick = at.tick
    g.first_knot = -at.knots_before


@kernel
def _note(tape: Record, bin: Record, value: float, block: int, fresh: bool) -> None:
    if fresh or value < bin.low:
        bin.low = value
    if fresh or value > bin.high:
        bin.high = value
    if fresh:
        bin.block = block
    if abs(value) > abs(tape.peak):
        tape.peak = value
        tape.peak_tick = tape.tick
    change = value - tape.value
    if abs(change) > abs(tape.steepest):  # never of the first, which comes from NaN
        tape.steepest = change
        tape.steepest_tick = tape.tick
    tape.value = value


@entry
def _play(
    g_address: int,
    table_address: int,
    tape_address: int,
    bins_address: int,
    segments_follow: bool,
    knots_follow: bool,
    period_s: float,
) -> None:
    """Play to the end of the tape, or until more of the program is needed."""
    g = carray(pointer(g_address), 1, GENERATOR)[0]
    table = carray(pointer(table_address), 1, TABLE)[0]
    tape = carray(pointer(tape_address), 1, TAPE)[0]
    bins = carray(pointer(bins_address), tape.bins, BIN)
    g.segments_ready = table.count
    g.knots_ready = table.knot_count
    at = tape.tick * tape.bins // tape.ticks
    last_bin = at if tape.tick > 0 else -1
    while tape.tick < tape.ticks:
        if segments_follow and g.segments_ready - g.segment <= 2 * MOST_SEGMENTS_A_TICK:
            return
        if knots_follow and g.knots_ready - g.knot <= 4 * MOST_SEGMENTS_A_TICK:
            return
        generate(g, table, False, False, _HOLD_TICKS, _STOP_TICKS, period_s)
        at = tape.tick * tape.bins // tape.ticks
        _note(tape, bins[at], g.value, g.block, at != last_bin)
        last_bin = at
        tape.tick += 1


class Player:
    """Plays a course from a START record on: at rest, or in the middle of its first segment."""

    def __init__(self, course: Course, period_s: float, at: Any = None) -> None:
        self._period_s = period_s
        self._table = np.zeros(1, TABLE)
        self._generator = np.zeros(1, GENERATOR)
        self._writer = TableWriter(self._table[0], course)
        self._begun = np.zeros(1, START)
        if at is not None:
            self._begun[0] = at
        set_down(
            address_of(self._generator),
            address_of(self._table),
            address_of(self._begun),
            period_s,
        )

    def play(self, ticks: int, bins: int) -> tuple[Records, Any]:
        """So many ticks in so many bins of equal length, (bins,) BIN, and the TAPE record of them."""
        found, tape = np.zeros(bins, BIN), np.zeros(1, TAPE)
        tape["ticks"], tape["bins"], tape["value"] = ticks, bins, math.nan
        while int(tape[0]["tick"]) < ticks:
            g = self._generator[0]
            self._writer.fill(int(g["segment"]), int(g["knot"]))
            _play(
                address_of(self._generator),
                address_of(self._table),
                address_of(tape),
                address_of(found),
                self._writer.segments_follow,
                self._writer.knots_follow,
                self._period_s,
            )
        return found, tape[0]
