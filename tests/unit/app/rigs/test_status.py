"""The status, read off a block."""

import json
import math
from dataclasses import replace
from time import monotonic_ns
from types import SimpleNamespace
from typing import Any, cast

import pytest

from app.link.life import Life
from app.link.link import Link
from app.recording.recorder import Recorder, RecorderState
from app.rigs.schemas import RigStatus
from app.rigs.status import StatusReader
from app.runs.plans import Plans
from app.storage.schemas import StorageState, StorageWord
from rtcore.interlocks import Quantity
from rtcore.modes import Mode
from tests.written_block import APP_SILENCE, FORCE_ERROR, FORCE_HINT, PERIOD_S, WrittenBlock

ROOM = StorageState(free_bytes=10**12, state=StorageWord.OK, seconds_left=1e6)
IDLE = RecorderState(recording=False, lost_ticks=0, size_bytes=0, trouble=None)


def reader(
    life: Life | None,
    *,
    starting: bool = False,
    plans: Plans | None = None,
    state: RecorderState = IDLE,
) -> StatusReader:
    link = cast(Link, SimpleNamespace(life=life, starting=starting))
    recorder = cast(Recorder, SimpleNamespace(state=lambda: state, following=life))
    return StatusReader(link, recorder, plans or Plans(), 21e6, lambda: ROOM)


def read(loop: WrittenBlock, age_s: float = 0.0, **options: Any) -> RigStatus:
    loop.block.fields["loop_heartbeat_ns"] = monotonic_ns() - int(age_s * 1e9)
    return reader(loop.life(), **options).read()


@pytest.fixture
def loop() -> WrittenBlock:
    written = WrittenBlock()
    written.ticks(100)
    return written


def test_before_the_first_sign_of_life_it_is_starting() -> None:
    status = reader(None, starting=True).read()
    assert (status.mode, status.loop.alive) == ("starting", False)
    assert reader(None).read().mode == "lost"
    assert set(status.readings.values()) == {None}


@pytest.mark.parametrize(("age_s", "mode"), [(0.1, "off"), (0.9, "lost")])
def test_within_a_second_of_silence_the_loop_is_lost(
    loop: WrittenBlock, age_s: float, mode: str
) -> None:
    loop.go(Mode.OFF)
    loop.ticks(1)
    status = read(loop, age_s)
    assert (status.mode, status.loop.alive) == (mode, mode == "off")
    assert (status.commands.pressurise is None) == (mode == "off")


def test_what_is_latched_is_told_with_the_first_on_top(loop: WrittenBlock) -> None:
    loop.trip(APP_SILENCE, 0.5, 0.5)
    loop.ticks(5)
    loop.trip(FORCE_ERROR, 7000.0, 6000.0)
    loop.block.fields["first_out"] = APP_SILENCE
    loop.ticks(1, trips=1 << APP_SILENCE | 1 << FORCE_ERROR)
    trips = read(loop).trips
    assert [(trip.code, trip.tick, trip.first) for trip in trips] == [
        ("app_silence", 100, True),
        ("force_error", 105, False),
    ]
    assert read(loop).commands.start == f"Press Reset first: {trips[0].text}"


def test_an_indication_is_told_and_keeps_nobody_from_starting(loop: WrittenBlock) -> None:
    loop.go(Mode.READY)
    loop.trip(FORCE_HINT, 1200.0, 1000.0)
    loop.ticks(1, trips=1 << FORCE_HINT)
    status = read(loop)
    assert [(trip.code, trip.blocks) for trip in status.trips] == [("force", False)]
    assert status.commands.start is None


def test_the_chain_is_what_its_detector_sees(loop: WrittenBlock) -> None:
    loop.ticks(1)
    assert read(loop).chain.closed is None  # none of these detectors looks at it
    table = loop.block.fields["interlocks"][int(loop.block.fields["active_interlocks"])]
    table["detectors"]["quantity"][APP_SILENCE] = Quantity.CHAIN_OPEN
    for value, closed in ((0.0, True), (1.0, False)):
        loop.block.fields["detector_values"][APP_SILENCE] = value
        assert read(loop).chain.closed is closed
    assert read(loop, age_s=2.0).chain.closed is None


def test_what_is_no_number_is_null(loop: WrittenBlock) -> None:
    loop.ticks(1, force_n=math.nan, velocity_m_s=math.inf)
    status = read(loop)
    assert status.readings["force_n"] is None
    assert status.readings["velocity_m_s"] is None
    json.loads(status.model_dump_json(), parse_constant=lambda word: pytest.fail(word))


def test_the_time_in_a_mode_counts_from_its_event(loop: WrittenBlock) -> None:
    loop.go(Mode.OFF)
    loop.ticks(41)
    assert read(loop).mode_since_s == pytest.approx(40 * PERIOD_S)


def test_limits_are_those_of_the_detectors_in_force(loop: WrittenBlock) -> None:
    limits = read(loop).limits
    assert (limits.force_error_n, limits.force_n, limits.velocity_m_s) == (6000.0, 1000.0, None)


def test_the_run_under_way_with_what_is_expected_of_it(loop: WrittenBlock) -> None:
    plans = Plans()
    plan = {"blocks": [{"cycles": 0}, {"cycles": 200}], "duration_s": 4.8}
    plans.remember(7, "Harmonic", plan)
    loop.begin(7)
    loop.ticks(41, run=7, block=1, cycle=17)
    loop.block.fields["program_ticks"] = 40  # one of them held
    run = read(loop, plans=plans).run
    assert run is not None
    assert run.model_dump() == {
        "id": 7,
        "test_name": "Harmonic",
        "block": 1,
        "blocks": 2,
        "cycle": 17,
        "cycles": 200,
        "elapsed_s": pytest.approx(40 * PERIOD_S),
        "duration_s": 4.8,
        "recorded_s": 0.0,
    }


def test_what_is_recorded_of_the_run_goes_on_where_its_program_holds(loop: WrittenBlock) -> None:
    plans = Plans()
    plans.remember(7, "Harmonic", {"blocks": [{"cycles": 0}], "duration_s": 4.8})
    loop.begin(7)
    loop.ticks(41, run=7)
    loop.block.fields["program_ticks"] = 1

    def recorded_s(run_id: int) -> float:
        run = read(loop, plans=plans, state=replace(IDLE, run_id=run_id, ticks=41)).run
        assert run is not None
        return run.recorded_s

    assert recorded_s(7) == pytest.approx(41 * PERIOD_S)
    assert recorded_s(6) == 0.0  # it still ends the one before


def test_what_is_missing_for_a_start_is_told(loop: WrittenBlock) -> None:
    loop.go(Mode.OFF)
    loop.ticks(1)
    found = {p.name: p.met for p in read(loop).permissives}
    assert found == {
        "loop": True,
        "interlocks": True,
        "pressure": False,
        "recorder": True,
        "storage": True,
        "idle": True,
    }
    assert not any(p.met for p in reader(None).read().permissives if p.name in ("loop", "recorder"))
