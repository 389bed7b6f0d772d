"""The whole tick on the virtual clock: modes, runs, commands, tare, tick by tick."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.modes import Mode
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import (
    PERIOD_S,
    gains,
    harmonic,
    interlocks,
    program,
    step,
)
from tests.unit.rtcore.virtual_rigs import LONG, kinds, make


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


def test_an_operators_stop_ends_ready(running: Virtual) -> None:
    assert running.command(Opcode.STOP) == Reply.ACCEPTED
    records = running.advance(3000)
    assert records["mode"][-1] == Mode.READY
    assert records["trips"][-1] == 0


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
