"""Programs longer than their bank, streamed to the loop while it plays them."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.memory.playing import read_playing
from rtcore.modes import Mode
from rtcore.program.segments import KNOT, MAX_KNOTS, MAX_SEGMENTS, SEGMENT, Segment
from rtcore.program.stream import Course, Program
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import PERIOD_S, Row, program
from tests.unit.rtcore.virtual_rigs import LONG, kinds, make


def segments(*rows: Row) -> npt.NDArray[Any]:
    records = np.zeros(len(rows), SEGMENT)
    for record, row in zip(records, rows, strict=True):
        for name, value in row.items():
            record[name] = value
    return records


END = segments({"kind": Segment.END})
STILL = Course([END])


def there_and_back() -> list[Row]:
    return [
        {"kind": Segment.LINEAR, "target": 500.0, "ticks": 3},
        {"kind": Segment.LINEAR, "target": -500.0, "ticks": 4},
    ]


def knots_in_parts(values: npt.NDArray[np.float64]) -> Iterator[npt.NDArray[Any]]:
    for part in np.array_split(values, 37):
        knots = np.zeros(len(part), KNOT)
        knots["value"] = part
        yield knots


def playing(values: npt.NDArray[np.float64], given: int | None = None) -> Program:
    """Samples at the loop's own rate, of which perhaps not all are given."""
    row = {
        "kind": Segment.SAMPLES,
        "ticks": len(values) - 1,
        "times": len(values),
        "rate_per_s": 1.0 / PERIOD_S,
        "mean_to": np.nan,
    }
    knots = knots_in_parts(values[:given])
    return Program(Course([segments(row), END], knots), STILL)


@pytest.fixture
def ready() -> Virtual:
    rig = make()
    rig.bring_to_ready()
    return rig


def test_a_streamed_program_gives_the_setpoint_of_the_same_with_a_loop(ready: Virtual) -> None:
    passes = 3 * MAX_SEGMENTS
    loop = program([*there_and_back(), {"kind": Segment.REPEAT, "jump": 0, "times": passes}])
    assert ready.load_program(loop) == Reply.ACCEPTED
    looped = ready.run()
    unrolled = Program(Course(iter([*[segments(*there_and_back())] * passes, END])), STILL)
    assert ready.load_program(unrolled) == Reply.ACCEPTED
    streamed = ready.run()
    assert (streamed["force_command_n"] == looped["force_command_n"]).all()
    assert len(streamed) > 7 * passes


def test_nothing_of_a_new_stream_is_overwritten_before_it_starts(ready: Virtual) -> None:
    passes = 3 * MAX_SEGMENTS

    def run() -> npt.NDArray[Any]:
        unrolled = Course(iter([*[segments(*there_and_back())] * passes, END]))
        assert ready.load_program(Program(unrolled, STILL)) == Reply.ACCEPTED
        ready.advance(3000)
        return np.asarray(ready.run()["force_command_n"])

    assert (run() == run()).all()


def test_samples_that_wrap_around_their_ring_are_played_to_the_last(ready: Virtual) -> None:
    ticks = np.arange(2 * MAX_KNOTS + 4321)
    values = 300.0 * np.sin(2 * np.pi * ticks / 997.0)
    assert ready.load_program(playing(values)) == Reply.ACCEPTED
    records = ready.run()
    assert records["force_command_n"][: len(values) - 1] == pytest.approx(values[:-1], abs=1e-3)
    assert ready.mode == Mode.READY
    assert EventKind.PROGRAM_FAULT not in ready.events()["kind"]


def test_a_stream_that_breaks_off_takes_the_load_off_and_latches(ready: Virtual) -> None:
    values = np.linspace(0.0, 3000.0, 20_000)
    ready.load_program(playing(values, given=8000))
    ready.events()
    records = ready.run()
    commanded = records["force_command_n"]
    assert commanded[7000] == pytest.approx(values[7000], abs=0.1)
    assert np.abs(np.diff(commanded)).max() < 3.0
    assert commanded[records["mode"] == Mode.STOPPING][-1] == pytest.approx(0.0, abs=0.1)
    assert ready.mode == Mode.TRIPPED
    assert kinds(ready, EventKind.PROGRAM_FAULT) == [0]


def test_segments_that_do_not_come_take_the_load_off_too(ready: Virtual) -> None:
    rows = [segments(*there_and_back())] * MAX_SEGMENTS
    ready.load_program(Program(Course(iter(rows)), STILL))  # no END
    records = ready.run()
    assert np.abs(np.diff(records["force_command_n"])).max() <= 335.0
    played = records[records["mode"] == Mode.RUNNING]
    assert (len(played), played["force_command_n"][-1]) == (7 * MAX_SEGMENTS, -250.0)
    assert ready.mode == Mode.TRIPPED


@pytest.mark.parametrize("wrong", [60e3, np.nan, -np.inf])
def test_a_knot_beyond_the_limits_trips(ready: Virtual, wrong: float) -> None:
    values = np.zeros(5000)
    values[4000:] = wrong
    ready.load_program(playing(values))
    ready.events()
    records = ready.run()
    assert ready.mode == Mode.TRIPPED
    assert kinds(ready, EventKind.PROGRAM_FAULT) == [1]
    assert np.abs(records["valve_command"]).max() < 0.2


@pytest.mark.parametrize(
    "row",
    [
        {"kind": Segment.SMOOTH, "target": 60e3, "ticks": 4000},
        {"kind": 9, "ticks": 10},
        {"kind": Segment.REPEAT, "jump": 0, "times": 5},
    ],
)
def test_a_streamed_segment_that_leads_astray_trips(ready: Virtual, row: Row) -> None:
    good = [segments(*there_and_back())] * MAX_SEGMENTS
    ready.load_program(Program(Course(iter([*good, segments(row), END])), STILL))
    assert np.abs(ready.run()["force_n"]).max() < 2e3
    assert ready.mode == Mode.TRIPPED


def test_what_is_streamed_is_played_once(ready: Virtual) -> None:
    ready.load_program(playing(np.zeros(100)))
    ready.run()
    assert ready.command(Opcode.START, 2) == Reply.NO_PROGRAM
    assert ready.load_program(LONG) == Reply.ACCEPTED
    assert ready.command(Opcode.START, 2) == Reply.ACCEPTED


@pytest.mark.parametrize("other", [{"times": 1}, {"rate_per_s": np.nan}, {"rate_per_s": 5e3}])
def test_samples_without_sense_are_refused(ready: Virtual, other: Row) -> None:
    row = {"kind": Segment.SAMPLES, "ticks": 10, "times": 11, "rate_per_s": 4e3}
    assert ready.load_program(program([row | other])) == Reply.INVALID_BANK


def test_how_far_the_program_is_can_be_read_from_outside(ready: Virtual) -> None:
    ready.load_program(LONG)
    ready.command(Opcode.START, 1)
    ready.advance(1234)
    states = read_playing(ready.block)
    assert states is not None
    assert states[0] == ready.io.core["force"]
    assert states[1] == ready.io.core["motion"]
    assert states[0]["value"] == ready.io.core["force"]["value"] != 0.0
