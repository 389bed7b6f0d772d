"""The score of a drill: each expectation fails by itself where what was recorded falls short of it."""

import math
from typing import Any

import numpy as np
import pytest

from app.drills.drills import DRILL, DRILLS, Drill
from app.drills.scoring import (
    BLED_S,
    SAFE_S,
    TAIL_S,
    Limits,
    Seen,
    is_over,
    reaction_of,
    score,
)
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record
from rtcore.channels import TELEMETRY
from rtcore.codes import EventKind
from rtcore.memory.layout import EVENT
from rtcore.modes import Mode
from rtcore.rig.parameters import load_rig

PERIOD_S = 250e-6
TICK = 1000
NAMES = [d.name for d in default_interlocks().detectors]
LIMITS = Limits.of(load_rig())


def event(tick: int, kind: EventKind, code: int) -> tuple[int, EventKind, int]:
    return tick, kind, code


def seen(
    *reported: tuple[int, EventKind, int],
    tripped: int | None = None,
    ticks: int = 8000,
    **values: Any,
) -> Seen:
    """A drill with these events; from `tripped` on the rig is safe, unless `values` say otherwise."""
    records = np.zeros(ticks, TELEMETRY)
    records["tick"] = TICK + np.arange(ticks)
    records["mode"] = Mode.RUNNING
    records["supply_pressure_pa"] = 21e6
    told = list(reported)
    if tripped is not None:
        after = records["tick"] >= tripped
        records["mode"][after] = Mode.TRIPPED
        records["supply_pressure_pa"][after] = 0.3e6
        told.append((tripped, EventKind.MODE, Mode.TRIPPED))
    for name, value in values.items():
        records[name][-1] = value
    events = np.zeros(len(told), EVENT)
    for row, (tick, kind, code) in zip(events, told, strict=True):
        row["tick"], row["kind"], row["code"] = tick, kind, code
    table = to_record(default_interlocks(), PERIOD_S)["detectors"][: len(NAMES)]
    return Seen(TICK, Mode.RUNNING, PERIOD_S, records, events, table, NAMES)


def trip(tick: int, name: str) -> tuple[int, EventKind, int]:
    return tick, EventKind.TRIP, NAMES.index(name)


def failed(drill: Drill, found: Seen) -> set[str]:
    """The names of the expectations that were not met."""
    reaction = reaction_of(drill, Mode.RUNNING)
    assert reaction is not None
    return {e.name for e in score(drill, reaction, found, LIMITS).expectations if not e.met}


FROZEN = DRILL["load_cell_frozen"]


def test_a_reaction_as_it_must_be_passes() -> None:
    found = seen(trip(TICK + 200, "load_cell"), tripped=TICK + 200)
    scored = score(FROZEN, FROZEN.test, found, LIMITS)  # type: ignore[arg-type]
    assert scored.passed
    assert (scored.first_out, scored.action) == ("load_cell", "shutdown")
    assert (scored.reaction_ticks, scored.safe_ticks) == (200, 200)
    assert scored.mode_after == "tripped"


@pytest.mark.parametrize(
    ("found", "wrong"),
    [
        (seen(), {"first_out"}),
        (seen(trip(TICK + 100, "force"), tripped=TICK + 100), {"first_out"}),
        (seen(trip(TICK + 240, "load_cell"), tripped=TICK + 240), set()),
        (seen(trip(TICK + 241, "load_cell"), tripped=TICK + 241), {"in_time"}),
        (seen(trip(TICK + 200, "load_cell")), {"tripped"}),
        (
            seen(trip(TICK + 200, "load_cell"), tripped=TICK + 201 + round(SAFE_S / PERIOD_S)),
            {"tripped"},
        ),
        (
            seen(trip(TICK + 200, "load_cell"), tripped=TICK + 200, valve_command=0.1),
            {"valve_null"},
        ),
        (
            seen(trip(TICK + 200, "load_cell"), tripped=TICK + 200, mode=Mode.OFF),
            {"valve_null"},
        ),
        (
            seen(trip(TICK + 200, "load_cell"), tripped=TICK + 200, supply_pressure_pa=5e6),
            {"supply_off"},
        ),
        (
            seen(trip(TICK + 200, "load_cell"), tripped=TICK + 200, displacement_m=0.031),
            {"displacement_m_within"},
        ),
        (
            # 24 MPa on 25.92 cm²: the chambers tell what the load cell does not
            seen(trip(TICK + 200, "load_cell"), tripped=TICK + 200, pressure_1_pa=24e6),
            {"force_n_within"},
        ),
    ],
)
def test_what_falls_short_fails_by_itself(found: Seen, wrong: set[str]) -> None:
    assert failed(FROZEN, found) == wrong


def test_a_detector_that_only_indicates_is_no_first_out() -> None:
    found = seen(trip(TICK + 50, "underpeak"), trip(TICK + 200, "load_cell"), tripped=TICK + 200)
    assert failed(FROZEN, found) == set()


def test_of_several_in_a_tick_the_strongest_is_first_then_the_table_decides() -> None:
    stop, shutdown = trip(TICK + 9, "displacement"), trip(TICK + 9, "load_cell")
    assert seen(stop, shutdown).first_out() == (TICK + 9, NAMES.index("load_cell"))
    both = seen(trip(TICK + 9, "force"), shutdown)
    assert both.first_out() == (TICK + 9, NAMES.index("load_cell"))


def test_where_nothing_may_trip_a_trip_fails() -> None:
    air = DRILL["air_in_oil"]
    assert failed(air, seen()) == set()
    assert failed(air, seen(trip(TICK + 9, "force"), tripped=TICK + 9)) == {"load_stays"}


def test_a_sensor_that_is_broken_itself_is_not_believed() -> None:
    found = seen(trip(TICK + 1, "lvdt"), tripped=TICK + 2001, displacement_m=0.035)
    drill = DRILL["lvdt_open"]
    assert drill.test is not None
    peaks = {p.channel: p.value for p in score(drill, drill.test, found, LIMITS).peaks}
    assert peaks["displacement_m"] is None
    assert failed(drill, found) == set()
    nan = seen(trip(TICK + 1, "force"), tripped=TICK + 1, velocity_m_s=math.nan)
    scored = score(DRILL["load_cell_nan"], DRILL["load_cell_nan"].test, nan, LIMITS)  # type: ignore[arg-type]
    assert {p.channel for p in scored.peaks if p.value is None} == {"velocity_m_s"}


def test_it_is_over_when_the_supply_is_bled_or_too_much_time_has_passed() -> None:
    reaction = FROZEN.test
    assert reaction is not None
    for found, last_s in (
        (seen(), reaction.within_s + TAIL_S),
        (seen(trip(TICK + 200, "load_cell")), 0.05 + SAFE_S + TAIL_S),
        (seen(trip(TICK + 200, "load_cell"), tripped=TICK + 400), 0.1 + BLED_S + TAIL_S),
    ):
        last = TICK + round(last_s / PERIOD_S)
        assert not is_over(reaction, found, last - 1)
        assert is_over(reaction, found, last)


def test_every_first_out_of_the_table_is_a_detector_that_ships_or_may_come() -> None:
    """What a drill may trip must exist, or it could never pass."""
    for drill in DRILLS:
        for reaction in (drill.ready, drill.test):
            if reaction is not None and reaction.first_outs:
                assert set(reaction.first_outs) & set(NAMES)
