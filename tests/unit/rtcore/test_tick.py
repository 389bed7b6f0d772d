"""The whole tick on the virtual clock: what commands, detectors and silence do, tick by tick."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action, Comparison, Quantity
from rtcore.memory.commands import post
from rtcore.modes import Mode
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import (
    FORCE_LIMIT,
    HOLD_ROW,
    PERIOD_S,
    SILENCE,
    Row,
    detector,
    gains,
    harmonic,
    interlocks,
    program,
    step,
)

LONG = program(harmonic(2000.0, 50.0, 500))


def make(*detectors: Row, seed: int = 1) -> Virtual:
    return Virtual(gains(), interlocks(*detectors), seed=seed)


@pytest.fixture
def virtual() -> Virtual:
    return make()


@pytest.fixture
def running() -> Virtual:
    rig = make(FORCE_LIMIT, SILENCE)
    rig.bring_to_ready()
    assert rig.load_program(LONG) == Reply.ACCEPTED
    assert rig.command(Opcode.START, 7) == Reply.ACCEPTED
    rig.advance(2000)
    return rig


def kinds(rig: Virtual, kind: EventKind) -> list[int]:
    return [int(e["code"]) for e in rig.events() if e["kind"] == kind]


def test_it_starts_latched_with_no_supply(virtual: Virtual) -> None:
    records = virtual.advance(4000)
    assert set(records["mode"]) == {Mode.TRIPPED}
    assert records["supply_pressure_pa"].max() < 1e6
    assert not records["valve_command"].any()


def test_pressure_rises_through_low_to_high(virtual: Virtual) -> None:
    virtual.command(Opcode.RESET)
    virtual.command(Opcode.PRESSURISE)
    records = virtual.advance(12000)
    pressure = records["supply_pressure_pa"]
    ready = np.argmax(records["mode"] == Mode.READY)
    assert 0.5 < ready * PERIOD_S < 5.0
    assert pressure[ready] >= 19.0e6
    assert not records["valve_command"][: ready - 1].any()
    assert pressure.max() < 21.1e6
    virtual.command(Opcode.DEPRESSURISE)
    bled = virtual.advance(20000)["supply_pressure_pa"]
    assert bled[-1] < 1e6
    assert (np.diff(bled[100:]) < 5e3).all()


def test_the_same_seed_gives_the_same_run_bit_for_bit() -> None:
    def run(seed: int) -> npt.NDArray[Any]:
        rig = make(seed=seed)
        rig.bring_to_ready()
        rig.load_program(program(harmonic(2000.0, 50.0, 5), harmonic(0.002, 4.0, 1)))
        return rig.run()

    first, second, other = run(3), run(3), run(4)
    for name in first.dtype.names or ():
        assert first[name].tobytes() == second[name].tobytes()
    assert first["force_n"].tobytes() != other["force_n"].tobytes()


def test_a_run_has_its_number_from_start_to_the_end_of_stopping(virtual: Virtual) -> None:
    virtual.bring_to_ready()
    virtual.load_program(program(step(2000.0, 0.2)))
    before = virtual.tick
    records = virtual.run(argument=9)
    assert np.array_equal(np.diff(records["tick"]), np.ones(len(records) - 1))
    assert records["tick"][0] == before
    assert len(records) == pytest.approx((0.2 + 0.5) / PERIOD_S, abs=2)
    assert records["mode"][-1] == Mode.STOPPING
    assert records["force_command_n"][-1] == pytest.approx(0.0, abs=0.1)
    assert virtual.mode == Mode.READY
    assert kinds(virtual, EventKind.PROGRAM_ENDED) == [9]


def test_every_command_is_refused_where_it_means_nothing(virtual: Virtual) -> None:
    for opcode in (Opcode.START, Opcode.HOLD, Opcode.RESUME, Opcode.STOP, Opcode.PRESSURISE):
        expected = Reply.NO_PROGRAM if opcode == Opcode.START else Reply.WRONG_MODE
        assert virtual.command(opcode) == expected
    assert virtual.command(99) == Reply.UNKNOWN  # type: ignore[arg-type]
    assert virtual.mode == Mode.TRIPPED


def test_hold_and_resume(running: Virtual) -> None:
    assert running.command(Opcode.HOLD) == Reply.ACCEPTED
    records = running.advance(4000)
    assert set(records["mode"]) == {Mode.HOLDING}
    assert np.abs(records["force_command_n"][1500:]).max() < 1e-6
    cycle = records["cycle"][-1]
    assert running.block.fields["program_ticks"] == 2000 + 1
    assert running.command(Opcode.RESUME) == Reply.ACCEPTED
    records = running.advance(4000)
    assert running.block.fields["program_ticks"] == pytest.approx(2001 + 3000, abs=2)
    assert records["cycle"][0] == cycle
    assert records["cycle"][-1] == pytest.approx(cycle + 0.75 * 50, abs=1.01)
    assert records["force_command_n"].max() == pytest.approx(2000.0, rel=0.01)


@pytest.mark.parametrize(
    ("quantity", "threshold", "comparison"),
    [
        (Quantity.FORCE_N, 100.0, Comparison.MAGNITUDE_ABOVE),
        (Quantity.FORCE_ERROR_N, 30.0, Comparison.MAGNITUDE_ABOVE),
        (Quantity.VELOCITY_M_S, 1e-3, Comparison.MAGNITUDE_ABOVE),
        (Quantity.DISPLACEMENT_M, 1e-6, Comparison.MAGNITUDE_ABOVE),
        (Quantity.SUPPLY_PRESSURE_PA, 25e6, Comparison.BELOW),
    ],
)
def test_a_shutdown_is_safe_in_the_very_tick_of_the_violation(
    quantity: Quantity, threshold: float, comparison: Comparison
) -> None:
    armed = 1 << Mode.RUNNING
    rig = make(
        detector(quantity, threshold, Action.SHUTDOWN, comparison=comparison, armed_modes=armed)
    )
    rig.bring_to_ready()
    rig.load_program(program(harmonic(2000.0, 50.0, 500), harmonic(0.002, 4.0, 10)))
    rig.command(Opcode.START, 1)
    records = rig.advance(8000)
    tripped = np.argmax(records["mode"] == Mode.TRIPPED)
    assert records["mode"][tripped] == Mode.TRIPPED
    assert records["trips"][tripped] == 1
    column = {
        Quantity.FORCE_N: records["force_n"],
        Quantity.VELOCITY_M_S: records["velocity_m_s"],
        Quantity.DISPLACEMENT_M: records["displacement_m"],
    }.get(quantity)
    if column is not None:
        assert abs(column[tripped]) > threshold
        assert np.abs(column[:tripped]).max(initial=0.0) <= np.float32(threshold)
    assert not records["valve_command"][tripped:].any()
    assert (records["mode"][tripped:] == Mode.TRIPPED).all()
    assert records["supply_pressure_pa"][-1] < 2e6


def test_the_first_of_several_trips_is_kept() -> None:
    late = detector(Quantity.FORCE_N, 100.0, Action.SHUTDOWN, persistence_ticks=3)
    first = detector(Quantity.FORCE_N, 150.0, Action.INDICATE)
    rig = make(late, first)
    rig.bring_to_ready()
    rig.load_program(program(step(2000.0, 1.0)))
    rig.command(Opcode.START, 1)
    records = rig.advance(400)
    assert records["trips"][-1] == 0b11
    assert rig.block.fields["first_out"] == 1
    assert kinds(rig, EventKind.TRIP) == [1, 0]
    assert rig.command(Opcode.RESET) == Reply.ACCEPTED
    assert rig.block.fields["first_out"] == -1


def test_two_in_one_tick_are_both_kept_and_the_stronger_acts() -> None:
    rig = make(
        detector(Quantity.FORCE_N, 500.0, Action.HOLD),
        detector(Quantity.FORCE_N, 500.0, Action.SHUTDOWN),
    )
    rig.bring_to_ready()
    rig.load_program(program(step(2000.0, 1.0)))
    rig.command(Opcode.START, 1)
    records = rig.advance(400)
    tripped = np.argmax(records["trips"] != 0)
    assert records["trips"][tripped] == 0b11
    assert records["mode"][tripped] == Mode.TRIPPED


def test_a_reset_is_refused_while_the_cause_is_there() -> None:
    faulty = detector(
        Quantity.SENSOR_FAULTS, 0.5, Action.SHUTDOWN, comparison=Comparison.ABOVE, armed_modes=0x7F
    )
    rig = make(faulty)
    rig.advance(10)
    rig.io.world["plant"]["omega_lc_rad_s"] = np.nan  # the load cell's chain gives no number
    records = rig.advance(3)
    assert records["trips"][-1] == 1
    assert np.isnan(records["force_n"][-1])
    assert rig.command(Opcode.RESET) == Reply.CAUSE_PRESENT
    assert rig.mode == Mode.TRIPPED


def test_silence_of_the_app_stops_the_load_in_a_controlled_way_and_latches(
    running: Virtual,
) -> None:
    running.app_beats = False
    records = running.advance(8000)
    silent = np.argmax(records["mode"] == Mode.STOPPING)
    assert silent * PERIOD_S == pytest.approx(0.5, abs=2 * PERIOD_S)
    assert not (records["mode"][:silent] != Mode.RUNNING).any()
    tripped = np.argmax(records["mode"] == Mode.TRIPPED)
    assert (tripped - silent) * PERIOD_S == pytest.approx(0.5, abs=2 * PERIOD_S)
    assert abs(records["force_command_n"][tripped - 1]) < 1.0
    assert abs(records["force_n"][tripped - 1]) < 100.0
    assert records["trips"][-1] == 0b10
    assert (records["run"][: tripped + 100] == 7).all()
    running.app_beats = True
    assert set(running.advance(4000)["mode"]) == {Mode.TRIPPED}


def test_an_operators_stop_ends_ready(running: Virtual) -> None:
    assert running.command(Opcode.STOP) == Reply.ACCEPTED
    records = running.advance(3000)
    assert records["mode"][-1] == Mode.READY
    assert records["trips"][-1] == 0


def test_a_shutdown_by_command_trips_at_once(running: Virtual) -> None:
    assert running.command(Opcode.SHUTDOWN) == Reply.ACCEPTED
    assert running.mode == Mode.TRIPPED


def test_nothing_is_adopted_during_a_run(running: Virtual) -> None:
    for opcode in (Opcode.ADOPT_GAINS, Opcode.ADOPT_INTERLOCKS):
        assert running.command(opcode, 1) == Reply.WRONG_MODE
    assert running.load_program(LONG) == Reply.WRONG_MODE


@pytest.mark.parametrize(
    "row",
    [
        {"kind": 9},
        {"kind": 2, "target": 60e3, "ticks": 10},
        {"kind": 2, "target": np.nan, "ticks": 10},
        {"kind": 3, "target": np.nan, "ticks": 10},
        {"kind": 2, "target": 1e3, "rate_per_s": 0.0},
        {"kind": 2, "target": 1e3, "rate_per_s": np.inf},
        {"kind": 2, "target": 40e3, "rate_per_s": 1e-15},
        {
            "kind": 4,
            "ticks": 9,
            "amplitude_from": 50e3,
            "frequency_from_hz": 1,
            "frequency_to_hz": 1,
        },
        {"kind": 4, "ticks": 10, "amplitude_to": 60e3, "frequency_to_hz": 1.0, "continues": 1},
        {"kind": 4, "ticks": 10, "amplitude_to": 1e3, "frequency_to_hz": 3e3, "continues": 1},
        {"kind": 4, "ticks": 10, "amplitude_to": np.nan, "frequency_to_hz": 1.0, "continues": 1},
        {"kind": 1, "ticks": -1},
        {"kind": 5, "jump": 5, "times": 2},
        {"kind": 5, "jump": 0, "times": 0},
    ],
)
def test_a_program_that_leads_astray_is_refused_whole(virtual: Virtual, row: Row) -> None:
    good = program([HOLD_ROW | {"ticks": 10}])
    assert virtual.load_program(good) == Reply.ACCEPTED
    active = int(virtual.block.fields["active_program"])
    assert virtual.load_program(program([HOLD_ROW | {"ticks": 10}, row])) == Reply.INVALID_BANK
    assert virtual.block.fields["active_program"] == active
    virtual.bring_to_ready()
    assert virtual.command(Opcode.START, 1) == Reply.ACCEPTED


def test_repeats_that_nest_too_deep_are_refused(virtual: Virtual) -> None:
    def nested(depth: int) -> Any:
        repeat = {"kind": 5, "jump": 0, "times": 2}
        return program([HOLD_ROW | {"ticks": 1}, *[repeat] * depth])

    assert virtual.load_program(nested(9)) == Reply.INVALID_BANK
    assert virtual.load_program(nested(8)) == Reply.ACCEPTED
    virtual.bring_to_ready()
    ticks = len(virtual.run())
    assert ticks == pytest.approx(2**8 + 0.5 / PERIOD_S, abs=3)


def test_a_large_program_is_checked_over_many_ticks(virtual: Virtual) -> None:
    rows = [HOLD_ROW | {"ticks": 1}] * 3000
    before = virtual.tick
    assert virtual.load_program(program(rows)) == Reply.ACCEPTED
    assert virtual.tick - before > 3000 / 40


def test_bad_gains_are_refused(virtual: Virtual) -> None:
    for name, value in (("k_p", np.nan), ("valve_limit", 1.5), ("low_pass_order", 3)):
        wrong = gains()
        wrong[name] = value
        virtual.block.fields["gains"][0] = wrong
        assert virtual.command(Opcode.ADOPT_GAINS, 0) == Reply.INVALID_BANK
    assert virtual.command(Opcode.ADOPT_GAINS, 5) == Reply.INVALID_BANK
    assert virtual.block.fields["active_gains"] == 1


def test_there_is_no_pressure_without_gains_and_interlocks() -> None:
    rig = make()
    rig.command(Opcode.RESET)
    for name in ("has_gains", "has_interlocks"):
        rig.io.core[name] = 0
        assert rig.command(Opcode.PRESSURISE) == Reply.NOT_CONFIGURED
        rig.io.core[name] = 1
    assert rig.command(Opcode.PRESSURISE) == Reply.ACCEPTED


def test_a_rig_does_not_begin_with_gains_that_the_loop_refuses() -> None:
    wrong = gains()
    wrong["k_p"] = np.nan
    with pytest.raises(ValueError, match="gains"):
        Virtual(wrong, interlocks())
    unstable = gains()
    unstable["low_pass_order"] = 2
    unstable["low_pass_rad_s"] = 2.0 * np.pi * 2100.0
    with pytest.raises(ValueError, match="gains"):
        Virtual(unstable, interlocks())


def test_a_valve_command_that_is_no_number_trips_in_its_tick(virtual: Virtual) -> None:
    virtual.bring_to_ready()
    virtual.io.core["law"]["compensation"]["lead"]["s1"] = np.nan
    records = virtual.advance(4)
    assert records["mode"][0] == Mode.TRIPPED
    assert not records["valve_command"].any()


def test_a_detector_of_a_new_table_is_not_hidden_by_an_old_trip(virtual: Virtual) -> None:
    rig = make(detector(Quantity.FORCE_N, 1e-3, Action.INDICATE))
    rig.bring_to_ready()
    rig.advance(100)
    assert rig.io.core["trips"] == 1
    rig.block.fields["interlocks"][0] = interlocks(
        detector(Quantity.SUPPLY_PRESSURE_PA, 1.0, Action.SHUTDOWN)
    )
    assert rig.command(Opcode.ADOPT_INTERLOCKS, 0) == Reply.ACCEPTED
    rig.advance(2)
    assert rig.mode == Mode.TRIPPED
    assert rig.block.fields["first_out"] == 0


def test_a_slew_limit_does_not_wind_the_integrator_up() -> None:
    """The same step under a slow valve overshoots no more than under a fast one, and settles."""
    limited = gains()
    limited["valve_slew_per_s"] = 5.0
    peaks = []
    for settings in (gains(), limited):
        rig = Virtual(settings, interlocks())
        rig.bring_to_ready()
        rig.load_program(program(step(5000.0, 1.0)))
        rig.command(Opcode.START, 1)
        force = rig.advance(3500)["force_n"]
        peaks.append(force.max())
        assert force[-1000:].std() < 20.0
    assert peaks[1] < 1.1 * peaks[0]


def test_a_reset_does_not_erase_why_a_stop_ends_latched(running: Virtual) -> None:
    running.app_beats = False
    assert running.advance(2200)["mode"][-1] == Mode.STOPPING
    running.app_beats = True
    assert running.command(Opcode.RESET) == Reply.CAUSE_PRESENT
    assert running.advance(2200)["mode"][-1] == Mode.TRIPPED
    assert running.io.core["trips"] == 0b10
    assert running.command(Opcode.RESET) == Reply.ACCEPTED


def test_a_reset_does_not_cut_the_recording_of_a_trip(running: Virtual) -> None:
    running.command(Opcode.SHUTDOWN)
    running.advance(40)
    running.command(Opcode.RESET)
    records = running.advance(4000)
    assert (records["run"] == 7).sum() == pytest.approx(0.5 / PERIOD_S - 41, abs=3)


def test_blocks_are_reported_from_the_first_on(virtual: Virtual) -> None:
    virtual.bring_to_ready()
    virtual.load_program(program([*step(100.0, 0.01, block=0), *step(0.0, 0.01, block=1)]))
    virtual.run()
    assert kinds(virtual, EventKind.BLOCK) == [0, 1]


def test_a_run_needs_a_number(virtual: Virtual) -> None:
    virtual.bring_to_ready()
    virtual.load_program(LONG)
    assert virtual.command(Opcode.START, 0) == Reply.NO_PROGRAM
    assert virtual.mode == Mode.READY


def test_a_program_refilled_while_it_is_checked_is_not_half_checked(virtual: Virtual) -> None:
    """The adoption of a stalled loop is refused by its expiry, and the next begins at the head."""
    virtual.block.fields["programs"][1] = program([HOLD_ROW | {"ticks": 1}] * 3000)
    first = post(virtual.block, Opcode.ADOPT_PROGRAM, 1, now_ns=0)
    virtual.advance(20)
    bad = [{"kind": 2, "target": 1e6, "ticks": 10}, *[HOLD_ROW | {"ticks": 1}] * 700]
    virtual.block.fields["programs"][1] = program(bad)
    virtual.block.fields["commands"][first % 64]["expires_ns"] = 0
    virtual.advance(1)
    assert reply_to(virtual, first) == Reply.EXPIRED
    assert virtual.command(Opcode.ADOPT_PROGRAM, 1) == Reply.INVALID_BANK
    assert virtual.io.core["has_program"] == 0


def test_a_replayed_a_late_and_a_stale_command_are_refused(virtual: Virtual) -> None:
    virtual.command(Opcode.RESET)
    sequence = post(virtual.block, Opcode.PRESSURISE)
    virtual.block.fields["commands"][sequence % 64]["sequence"] = sequence - 1
    virtual.advance(1)
    assert reply_to(virtual, sequence) == Reply.REPLAYED

    late = post(virtual.block, Opcode.PRESSURISE)
    virtual.block.fields["commands"][late % 64]["expires_ns"] = -1
    virtual.advance(1)
    assert reply_to(virtual, late) == Reply.EXPIRED

    post(virtual.block, Opcode.TARE, lease=5)
    stale = post(virtual.block, Opcode.PRESSURISE, lease=4)
    virtual.advance(2)
    assert reply_to(virtual, stale) == Reply.STALE_LEASE
    assert virtual.mode == Mode.OFF


def test_a_stop_needs_neither_lease_nor_haste(running: Virtual) -> None:
    post(running.block, Opcode.HOLD, lease=5)
    stop = post(running.block, Opcode.STOP, lease=1)
    running.block.fields["commands"][stop % 64]["expires_ns"] = -1
    running.advance(2)
    assert reply_to(running, stop) == Reply.ACCEPTED
    assert running.mode == Mode.STOPPING


def reply_to(rig: Virtual, sequence: int) -> int:
    return int(rig.block.fields["acknowledgements"][sequence % 64]["reply"])


def off_with_offset(rig: Virtual, offset_n: float, seconds: float) -> None:
    rig.command(Opcode.RESET)
    rig.io.core["sample"]["tare_n"] = -offset_n
    rig.advance(round(seconds / PERIOD_S))


def test_the_tare_makes_the_unloaded_mean_zero(virtual: Virtual) -> None:
    off_with_offset(virtual, 250.0, 3.0)
    assert virtual.advance(1000)["force_n"].mean() == pytest.approx(250.0, abs=3.0)
    assert virtual.command(Opcode.TARE) == Reply.ACCEPTED
    assert virtual.advance(1000)["force_n"].mean() == pytest.approx(0.0, abs=3.0)


def test_the_tare_is_refused_until_the_rig_has_rested(virtual: Virtual) -> None:
    off_with_offset(virtual, 0.0, 0.5)
    assert virtual.command(Opcode.TARE) == Reply.CAUSE_PRESENT


def test_a_load_is_no_offset(virtual: Virtual) -> None:
    virtual.bring_to_ready()
    virtual.load_program(program(step(20e3, 0.3)))
    virtual.command(Opcode.START, 1)
    virtual.advance(1000)
    virtual.command(Opcode.SHUTDOWN)
    virtual.command(Opcode.RESET)
    replies = []
    for _ in range(20):
        replies.append(virtual.command(Opcode.TARE))
        virtual.advance(200)
    assert set(replies) == {Reply.CAUSE_PRESENT}
    assert virtual.io.core["sample"]["tare_n"] == 0.0


def test_a_frozen_and_a_saturated_load_cell_are_faults() -> None:
    faulty = detector(
        Quantity.SENSOR_FAULTS, 0.5, Action.SHUTDOWN, comparison=Comparison.ABOVE, armed_modes=0x7F
    )
    rig = make(faulty)
    rig.advance(1000)
    assert rig.io.core["trips"] == 0
    rig.io.world["sensors"]["force_noise_n"] = 0.0
    records = rig.advance(1000)
    assert np.argmax(records["trips"] != 0) == pytest.approx(200, abs=20)

    rig = make(faulty)
    rig.io.core["settings"]["force_range_n"] = 1.0
    assert rig.advance(10)["trips"][-1] == 1


def test_missed_deadlines_are_all_counted_and_reported_once_a_second(virtual: Virtual) -> None:
    virtual.events()
    for _ in range(4000):
        virtual.io.cycle(0, 600_000, 0, 2)
    reports = [e for e in virtual.events() if e["kind"] == EventKind.DEADLINES_MISSED]
    assert virtual.io.core["deadlines_missed"] == 8000
    assert len(reports) == 1
    virtual.advance(4000)
    reports += [e for e in virtual.events() if e["kind"] == EventKind.DEADLINES_MISSED]
    assert sum(int(e["code"]) for e in reports) == 8000
    assert reports[-1]["value"] == 600_000
