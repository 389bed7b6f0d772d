"""Detectors on the whole tick: what trips, in which tick, and what is kept of it."""

import numpy as np
import pytest

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action, Comparison, Quantity
from rtcore.modes import Mode
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import (
    PERIOD_S,
    detector,
    harmonic,
    interlocks,
    program,
    step,
)
from tests.unit.rtcore.virtual_rigs import kinds, make


def test_it_starts_latched_with_no_supply(virtual: Virtual) -> None:
    records = virtual.advance(4000)
    assert set(records["mode"]) == {Mode.TRIPPED}
    assert records["supply_pressure_pa"].max() < 1e6
    assert not records["valve_command"].any()


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
    first = detector(Quantity.FORCE_N, 150.0, Action.STOP)
    rig = make(late, first)
    rig.bring_to_ready()
    rig.load_program(program(step(2000.0, 1.0)))
    rig.command(Opcode.START, 1)
    records = rig.advance(400)
    assert records["trips"][-1] == 0b11
    assert rig.block.fields["first_out"] == 1
    assert (
        rig.block.fields["first_out_tick"] == records["tick"][np.argmax(records["trips"] == 0b10)]
    )
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
        Quantity.LOAD_CELL, 0.5, Action.SHUTDOWN, comparison=Comparison.ABOVE, armed_modes=0x7F
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


def test_a_shutdown_by_command_trips_at_once(running: Virtual) -> None:
    assert running.command(Opcode.SHUTDOWN) == Reply.ACCEPTED
    assert running.mode == Mode.TRIPPED


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


def test_a_trip_whose_detector_is_gone_keeps_nothing_from_starting() -> None:
    rig = make(detector(Quantity.FORCE_N, 1e-3, Action.HOLD))
    rig.bring_to_ready()
    rig.advance(100)
    rig.load_program(program(harmonic(2000.0, 50.0, 5)))
    assert rig.command(Opcode.START, 1) == Reply.CAUSE_PRESENT
    rig.block.fields["interlocks"][0] = interlocks(
        detector(Quantity.SUPPLY_PRESSURE_PA, 1e9, Action.HOLD)
    )
    assert rig.command(Opcode.ADOPT_INTERLOCKS, 0) == Reply.ACCEPTED
    assert rig.command(Opcode.START, 1) == Reply.ACCEPTED


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


def test_a_frozen_and_a_saturated_load_cell_are_faults() -> None:
    faulty = detector(
        Quantity.LOAD_CELL, 0.5, Action.SHUTDOWN, comparison=Comparison.ABOVE, armed_modes=0x7F
    )
    rig = make(faulty)
    rig.advance(1000)
    assert rig.io.core["trips"] == 0
    rig.io.world["sensors"]["force_noise_n"] = 0.0
    records = rig.advance(1000)
    assert np.argmax(records["trips"] != 0) == pytest.approx(200, abs=20)

    rig = make(faulty)
    rig.io.core["sample"]["force"]["range"] = 1.0
    assert rig.advance(10)["trips"][-1] == 1
