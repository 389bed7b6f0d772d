"""Skipping within a chain of sines: no jump at any tick, cycles and positions counted right, all else refused."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.memory.commands import post
from rtcore.modes import Mode
from rtcore.program.generator import GENERATOR, generate, start
from rtcore.program.segments import MAX_SEGMENTS, SEGMENT, Segment
from rtcore.program.skipping import MOST_SKIPPED, can_skip, skip
from rtcore.program.stream import Course, Program
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import PERIOD_S, Row, program, table
from tests.unit.rtcore.virtual_rigs import make, reply_to

HOLD_FADE, STOP_FADE = 1000, 2000
AMPLITUDE_N, MEAN_N = 2000.0, 500.0
STEEPEST_N = 2 * np.pi * 40.0 * AMPLITUDE_N * PERIOD_S  # in a tick, of the fastest of these sines


def sine(hz: float, ticks: int, counts: int = 0, block: int = 0, **other: Any) -> Row:
    """A sine that continues, at full amplitude."""
    row: Row = {
        "kind": Segment.HARMONIC,
        "ticks": ticks,
        "mean_to": MEAN_N,
        "amplitude_to": AMPLITUDE_N,
    }
    row |= {"frequency_to_hz": hz, "continues": 1, "counts": counts, "block": block}
    return row | other


def points(*frequencies_hz: float) -> list[Row]:
    """Each blended into, settled and counted; the last tapers out."""
    rows: list[Row] = []
    for hz in frequencies_hz:
        rows += [sine(hz, 400), sine(hz, 200), sine(hz, round(10 / (hz * PERIOD_S)), counts=1)]
    return [*rows, sine(frequencies_hz[-1], 400, amplitude_to=0.0)]


class Skipped:
    """A table walked, with skips at some ticks."""

    def __init__(
        self, rows: Any, ticks: int, skips: dict[int, int], held: range = range(0)
    ) -> None:
        self.g = np.zeros(1, GENERATOR)[0]
        start(self.g, rows, 0.0, PERIOD_S)
        self.value: npt.NDArray[np.float64] = np.empty(ticks)
        self.cycle, self.position = np.empty(ticks, int), np.empty(ticks, int)
        self.left_out: dict[int, int] = {}
        for k in range(ticks):
            if k in skips and can_skip(self.g, rows, skips[k]):
                self.left_out[k] = skip(self.g, rows, skips[k], PERIOD_S)
            generate(self.g, rows, k in held, False, HOLD_FADE, STOP_FADE, PERIOD_S)
            self.value[k], self.cycle[k] = self.g["value"], self.g["cycle"]
            self.position[k] = self.g["position"]


ROWS = table(*points(20.0, 25.0, 40.0))
SEGMENTS = int(ROWS["count"]) - 1
LAST_OF_FIRST = 600 + 2000  # ticks: blend, settle, ten cycles of 20 Hz


@settings(deadline=None, max_examples=200)
@given(
    ats=st.lists(st.integers(1, 6500), max_size=4, unique=True),
    targets=st.lists(st.integers(0, SEGMENTS), min_size=4, max_size=4),
)
def test_the_setpoint_never_jumps_and_positions_tell_where_it_is(
    ats: list[int], targets: list[int]
) -> None:
    skips = dict(zip(sorted(ats), targets, strict=False))
    walked = Skipped(ROWS, 7000, skips)
    swing_n = MEAN_N * np.pi / 400 / 2  # as the mean is blended in
    assert np.abs(np.diff(walked.value)).max() <= STEEPEST_N + swing_n + 20.0
    steps = np.diff(walked.position)
    expected = {at: 1 + left for at, left in walked.left_out.items() if at > 0}
    ended = walked.position == walked.position[-1]
    for k, step in enumerate(steps, start=1):
        assert step == expected.get(k, 0 if ended[k - 1] else 1)
    assert (np.diff(walked.cycle) >= 0).all()


@pytest.mark.parametrize("turned", range(0, 200, 7))
def test_a_skip_at_any_tick_of_a_cycle_goes_on_smoothly(turned: int) -> None:
    """Value and slope: the second difference stays that of the sines themselves."""
    at = 600 + 800 + turned  # in the fifth counted cycle of 200 ticks
    walked = Skipped(ROWS, at + 300, {at: 3})
    assert walked.left_out == {at: LAST_OF_FIRST - at}
    around = walked.value[at - 3 : at + 4]
    bend = AMPLITUDE_N * (2 * np.pi * 20.0 * PERIOD_S) ** 2
    assert np.abs(np.diff(around, 2)).max() <= 1.6 * bend
    assert list(walked.position[at - 1 : at + 2]) == [at - 1, LAST_OF_FIRST, LAST_OF_FIRST + 1]


def test_only_whole_cycles_are_counted() -> None:
    at = 600 + 3 * 200 + 150  # three and three quarters
    walked = Skipped(ROWS, 9000, {at: 3})
    assert walked.cycle[at - 1] == walked.cycle[at] == 3
    assert walked.cycle[-1] == 3 + 10 + 10


def test_a_skip_to_the_counted_sine_cuts_settling_short() -> None:
    walked = Skipped(ROWS, 9000, {450: 2})
    assert walked.left_out == {450: 150}
    assert walked.cycle[450 + 200] == 1
    assert walked.cycle[-1] == 30


def test_a_skip_while_a_sine_is_blended_picks_up_what_it_was() -> None:
    before = Skipped(ROWS, 220, {})
    walked = Skipped(ROWS, 220, {200: 3})
    assert walked.value[200] == pytest.approx(before.value[200], abs=1e-9)
    assert 0 < walked.g["amplitude"] < AMPLITUDE_N  # still blending in


def test_a_hold_in_between_costs_nothing() -> None:
    held = range(1000, 3000)
    walked = Skipped(ROWS, 9000, {3500 + HOLD_FADE: 6}, held)
    assert set(walked.position[1000 : 3000 + HOLD_FADE - 1]) == {1000}
    assert np.abs(np.diff(walked.value)).max() <= STEEPEST_N + 20.0


BETWEEN = {
    "a repeat": [{"kind": Segment.REPEAT, "jump": 1, "times": 2}],
    "another block": [sine(25.0, 400, block=1)],
    "a hold": [{"kind": Segment.HOLD, "ticks": 10}],
    "a sine that begins by itself": [sine(25.0, 400, continues=0, frequency_from_hz=25.0)],
    "a sweep": [sine(25.0, 400, kind=Segment.SWEEP)],
}


@pytest.mark.parametrize("rows", BETWEEN.values(), ids=BETWEEN)
def test_what_lies_between_must_be_one_chain(rows: list[Row]) -> None:
    between = table(sine(20.0, 4000), *rows, sine(25.0, 400, block=rows[0].get("block", 0)))
    walked = Skipped(between, 50, {40: 2})
    assert walked.left_out == {}
    assert list(walked.position) == list(range(50))


@pytest.mark.parametrize("target", [-1, 0, 1, SEGMENTS, SEGMENTS + 1, MAX_SEGMENTS, 1 << 40])
def test_only_what_is_there_further_on_is_a_target(target: int) -> None:
    assert Skipped(ROWS, 500, {450: target}).left_out == {}  # within segment 1; the last is END


def test_a_leap_is_as_far_as_a_tick_can_look() -> None:
    rows = table(*(sine(20.0, 4) for _ in range(MOST_SKIPPED + 3)))
    assert Skipped(rows, 2, {1: MOST_SKIPPED + 1}).left_out == {}
    assert Skipped(rows, 2, {1: MOST_SKIPPED}).left_out == {1: 4 * MOST_SKIPPED - 1}


@pytest.fixture
def responding() -> Virtual:
    """In the counted cycles of the first point."""
    rig = make()
    rig.bring_to_ready()
    rig.load_program(program(points(20.0, 25.0, 40.0)))
    assert rig.command(Opcode.START, 1) == Reply.ACCEPTED
    rig.advance(1000)
    rig.events()
    return rig


def test_by_command_the_loop_skips_and_says_so(responding: Virtual) -> None:
    before = responding.advance(1)[-1]
    assert before["program_tick"] == before["tick"] - responding_start(responding)
    assert responding.command(Opcode.SKIP, 3) == Reply.ACCEPTED
    after = responding.advance(1)[-1]
    events = responding.events()
    told = events[events["kind"] == EventKind.SKIPPED][0]
    left_out = LAST_OF_FIRST - (int(before["program_tick"]) + 1)
    assert (int(told["code"]), int(told["value"])) == (3, left_out)
    assert after["program_tick"] - before["program_tick"] == 2 + left_out
    assert responding.block.fields["program_ticks"] == after["program_tick"] + 1


def responding_start(rig: Virtual) -> int:
    """The tick in which the run began."""
    return int(rig.block.ring["tick"][rig.block.ring["run"] == 1].min())


def test_outside_a_run_there_is_no_position(responding: Virtual) -> None:
    records = responding.advance(20_000)
    over = records["run"] == 0
    assert over.any()
    assert (records["program_tick"][over] == -1).all()
    assert (records["program_tick"][~over] >= 0).all()


def test_a_hold_and_the_end_of_a_run_refuse(responding: Virtual) -> None:
    responding.command(Opcode.HOLD)
    assert responding.command(Opcode.SKIP, 3) == Reply.WRONG_MODE
    responding.command(Opcode.STOP)
    assert responding.command(Opcode.SKIP, 3) == Reply.WRONG_MODE
    responding.advance(3000)
    assert responding.mode == Mode.READY
    assert responding.command(Opcode.SKIP, 3) == Reply.WRONG_MODE


def test_an_old_lease_and_what_is_gone_by_are_refused(responding: Virtual) -> None:
    assert responding.command(Opcode.TAKE_LEASE, lease=7) == Reply.ACCEPTED
    assert responding.command(Opcode.SKIP, 3, lease=6) == Reply.STALE_LEASE
    assert responding.command(Opcode.SKIP, 2) == Reply.INVALID_BANK  # where it is
    assert responding.command(Opcode.SKIP, -5) == Reply.INVALID_BANK
    assert responding.mode == Mode.RUNNING


def test_commands_in_a_row_are_each_taken_in_their_tick(responding: Virtual) -> None:
    sequences = [
        post(responding.block, Opcode.SKIP, to, now_ns=0, time_to_live_s=1e6) for to in (3, 3, 6)
    ]
    responding.advance(3)
    replies = [reply_to(responding, sequence) for sequence in sequences]
    assert replies == [Reply.ACCEPTED, Reply.INVALID_BANK, Reply.ACCEPTED]


def test_a_streamed_program_skips_too() -> None:
    many = [sine(20.0, 8) for _ in range(MAX_SEGMENTS + 500)] + [sine(20.0, 400, amplitude_to=0.0)]
    segments = np.zeros(len(many) + 1, SEGMENT)
    for record, row in zip(segments, many, strict=False):
        for name, value in row.items():
            record[name] = value
    segments[-1]["kind"] = Segment.END
    rig = make()
    rig.bring_to_ready()
    idle = Course([np.zeros(1, SEGMENT)])
    assert rig.load_program(Program(Course([segments]), idle)) == Reply.ACCEPTED
    rig.command(Opcode.START, 1)
    records = [rig.advance(1000)]
    for target in (1000, 2000, 3000, 4000, MAX_SEGMENTS + 400):
        assert rig.command(Opcode.SKIP, target) == Reply.ACCEPTED
        records.append(rig.advance(1100))
    assert rig.command(Opcode.SKIP, 3 * MAX_SEGMENTS) == Reply.INVALID_BANK
    last = records[-1][-1]
    assert last["program_tick"] >= 8 * (MAX_SEGMENTS + 400)
    began = 10  # the first sine comes in at once
    assert np.abs(np.diff(np.concatenate(records)["force_command_n"][began:])).max() < 150.0
