"""Faults of the simulated rig: what each does to plant and signals, and that none leaves a trace."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from bench.balances import balance
from rtcore.io import FAULT_SLOTS, INPUTS, OUTPUTS, SUPPLY_HIGH
from rtcore.rig.failing import take_faults
from rtcore.rig.faults import FAULTS, Fault
from rtcore.rig.fluid import specific_volume, specific_volume_law
from rtcore.rig.integrate import advance
from rtcore.rig.parameters import load_rig, rig_from
from rtcore.rig.plant import INPUTS as PLANT_INPUTS
from rtcore.rig.plant import (
    P_1,
    P_2,
    P_S,
    STATES,
    SUBSTEPS,
    U_BLEED,
    U_UNIT,
    U_VALVE,
    V_2,
    X_2,
    X_B,
    X_R,
    X_S,
    X_T,
    Y_F,
)
from rtcore.rig.sensors import read_sensors
from rtcore.rig.world import make_world, read_world, write_world
from tests.unit.rtcore.rig.plants import inputs, plant, pressurised, states

PERIOD_S = 250e-6
RAIL_N = 60e3


@cache
def settled(valve: float) -> Any:
    """(1,) WORLD: two and a half seconds after the pump was started, 0.2 s after a valve command."""
    worlds = make_world(load_rig(), seed=1)
    for k in range(10_800):
        step(worlds[0], np.zeros(1, INPUTS)[0], valve if k >= 10_000 else 0.0)
    return worlds


def step(world: Any, given: Any, valve: float) -> None:
    """A tick of the plant and its sensors, without anything that could spoil them."""
    outputs = np.zeros(1, OUTPUTS)[0]
    outputs["supply"], outputs["valve_command"] = SUPPLY_HIGH, valve
    advance(world["plant"], world["y"], world["u"], world["work"], PERIOD_S, SUBSTEPS)
    read_sensors(world["sensors"], world["plant"], world["noise"], world["y"], given)
    write_world(world, outputs, PERIOD_S)


class Bench:
    """A rig under pressure that is driven in the open loop, with faults to be given to it."""

    def __init__(self, valve: float = 0.02) -> None:
        self.worlds = settled(valve).copy()
        self.inputs, self.outputs = np.zeros(1, INPUTS)[0], np.zeros(1, OUTPUTS)[0]
        self.injected = np.zeros(FAULT_SLOTS)
        self.outputs["supply"] = SUPPLY_HIGH
        self.outputs["valve_command"] = valve
        self.run(PERIOD_S)

    @property
    def world(self) -> Any:
        return self.worlds[0]

    @property
    def y(self) -> Any:
        return self.worlds[0]["y"]

    def run(self, duration_s: float) -> Any:
        """(n,) INPUTS that the loop is given."""
        read = np.empty(round(duration_s / PERIOD_S), INPUTS)
        for k in range(len(read)):
            take_faults(self.world, self.injected)
            read_world(self.world, self.inputs, PERIOD_S)
            write_world(self.world, self.outputs, PERIOD_S)
            read[k] = self.inputs
        return read

    def give(self, fault: Fault, amount: float | None = None) -> None:
        self.injected[fault] = FAULTS[fault].default if amount is None else amount

    def mend(self, fault: Fault) -> None:
        self.injected[fault] = 0.0


def test_every_fault_is_in_the_table_with_a_default_within_its_bounds() -> None:
    assert list(FAULTS) == list(Fault)
    assert max(Fault) < FAULT_SLOTS
    for kind in FAULTS.values():
        assert kind.low <= kind.default <= kind.high
        assert kind.default != 0.0


# ---- nothing where there is no fault, and no trace ----


def test_a_sound_rig_is_the_plant_and_its_sensors_alone_bit_for_bit() -> None:
    bench, bare = Bench(), settled(0.02)[0].copy()
    given = np.zeros(1, INPUTS)[0]
    step(bare, given, 0.02)  # which the other did as it was made
    for _ in range(400):
        step(bare, given, -0.05)
    bench.outputs["valve_command"] = -0.05
    bench.run(400 * PERIOD_S)
    assert bare["y"].tobytes() != settled(0.02)[0]["y"].tobytes()
    assert bare["y"].tobytes() == bench.y.tobytes()
    assert given.tobytes() == bench.inputs.tobytes()


@pytest.mark.parametrize("fault", Fault, ids=lambda f: f.name)
def test_a_fault_that_comes_and_goes_leaves_everything_but_the_state_as_it_was(
    fault: Fault,
) -> None:
    bench, sound = Bench(), Bench()
    bench.give(fault)
    bench.run(0.05)
    bench.mend(fault)
    bench.run(PERIOD_S)
    world = bench.world
    for part in ("plant", "sensors"):
        assert world[part].tobytes() == sound.world[part].tobytes()
    assert world["failing"]["present"] == 0
    assert world["failing"]["drift_n"] == 0.0
    assert not np.any(world["failing"]["amounts"])
    # From the same state on it goes the same way, bit for bit.
    for name in ("y", "u", "noise", "work", "held_valve"):
        world[name] = sound.world[name]
    assert bench.run(0.02).tobytes() == sound.run(0.02).tobytes()


def test_what_is_beyond_its_bounds_is_held_at_them() -> None:
    bench = Bench(valve=0.0)
    bench.give(Fault.VALVE_NULL_SHIFT, 1.0)
    bench.run(0.01)
    assert bench.world["plant"]["null_m"] == 2e-4


def test_a_slot_that_no_fault_has_does_nothing() -> None:
    bench = Bench()
    bench.injected[0] = bench.injected[FAULT_SLOTS - 1] = 1.0
    bench.run(PERIOD_S)
    assert bench.world["failing"]["present"] == 0


# ---- what the loop reads ----


@pytest.mark.parametrize(("side", "code"), [(1.0, RAIL_N * (1 - 2**-15)), (-1.0, -RAIL_N)])
def test_an_open_load_cell_reads_the_rail_of_its_amplifier(side: float, code: float) -> None:
    bench = Bench()
    bench.give(Fault.LOAD_CELL_OPEN, side)
    assert np.all(bench.run(0.01)["force_n"] == code)


@pytest.mark.parametrize(
    ("fault", "name"),
    [(Fault.LOAD_CELL_FROZEN, "force_n"), (Fault.LVT_FROZEN, "velocity_m_s")],
)
def test_a_frozen_sensor_repeats_its_last_code(fault: Fault, name: str) -> None:
    bench = Bench()
    last = float(bench.inputs[name])
    bench.give(fault)
    assert np.all(bench.run(0.05)[name] == last)
    bench.mend(fault)
    assert len(np.unique(bench.run(0.05)[name])) > 10


def test_a_reversed_load_cell_reads_the_force_negated() -> None:
    bench, sound = Bench(), Bench()
    bench.give(Fault.LOAD_CELL_SIGN)
    assert np.array_equal(bench.run(0.02)["force_n"], -sound.run(0.02)["force_n"])


def test_noise_grows_by_its_factor_and_is_the_same_noise() -> None:
    bench, sound = Bench(valve=0.0), Bench(valve=0.0)
    bench.give(Fault.LOAD_CELL_NOISE, 50.0)
    noisy, quiet = bench.run(0.2)["force_n"], sound.run(0.2)["force_n"]
    assert np.std(noisy) == pytest.approx(50.0 * 8.0, rel=0.1)
    assert np.corrcoef(noisy, quiet)[0, 1] > 0.95


def test_a_load_cell_without_a_number_says_so() -> None:
    bench = Bench()
    bench.give(Fault.LOAD_CELL_NAN)
    assert np.all(np.isnan(bench.run(0.01)["force_n"]))
    assert math.isfinite(bench.y[Y_F])


def test_a_drifting_load_cell_wanders_at_its_rate_and_ends_at_the_rail() -> None:
    bench, sound = Bench(), Bench()
    bench.give(Fault.LOAD_CELL_DRIFT, 20e3)
    off = bench.run(0.5)["force_n"] - sound.run(0.5)["force_n"]
    assert off[-1] == pytest.approx(20e3 * 0.5, abs=4.0)
    assert np.all(np.diff(off) > 0.0)
    assert bench.run(3.0)["force_n"][-1] == RAIL_N * (1 - 2**-15)


def test_an_open_lvdt_reads_its_rail_and_an_open_chain_says_open() -> None:
    bench = Bench()
    assert np.all(bench.run(0.01)["chain"] == 1)
    bench.give(Fault.LVDT_OPEN)
    bench.give(Fault.CHAIN_OPEN)
    read = bench.run(0.01)
    assert np.all(read["displacement_m"] == 0.035 * (1 - 2**-15))
    assert np.all(read["chain"] == 0)


# ---- what the plant does ----


@pytest.mark.parametrize("place", [1.0, -1.0, 0.3])
def test_a_valve_that_is_hard_over_goes_there_whatever_the_command(place: float) -> None:
    bench = Bench(valve=0.0)
    bench.give(Fault.VALVE_HARD_OVER, place)
    bench.outputs["valve_command"] = -0.5 * place
    bench.run(0.05)
    assert bench.y[X_S] == pytest.approx(place * 0.8e-3, rel=1e-2)


def test_a_stuck_valve_stands_still_and_moves_again() -> None:
    bench = Bench(valve=0.1)
    stood = float(bench.y[X_S])
    bench.give(Fault.VALVE_STUCK)
    bench.outputs["valve_command"] = -0.3
    bench.run(0.05)
    assert bench.y[X_S] == stood
    bench.mend(Fault.VALVE_STUCK)
    bench.run(0.05)
    assert bench.y[X_S] == pytest.approx(-0.3 * 0.8e-3, rel=1e-2)


def test_a_shifted_null_drives_the_force_with_the_valve_at_null() -> None:
    bench = Bench(valve=0.0)
    assert abs(bench.y[Y_F]) < 50.0
    bench.give(Fault.VALVE_NULL_SHIFT, 4e-5)
    bench.run(0.5)
    sound = Bench(valve=4e-5 / 0.8e-3)
    sound.run(0.5)
    assert bench.y[Y_F] == pytest.approx(sound.y[Y_F], rel=0.01)


def test_a_lost_pump_delivers_nothing_while_the_accumulator_carries_on() -> None:
    bench = Bench(valve=0.1)
    bench.give(Fault.PUMP_LOSS)
    supply = []
    for _ in range(20):
        bench.run(0.05)
        supply.append(float(bench.y[P_S]))
    assert np.all(np.diff(supply) < 0.0)
    assert 12e6 < supply[-1] < 20.9e6
    bench.mend(Fault.PUMP_LOSS)
    bench.run(3.0)
    assert bench.y[P_S] == pytest.approx(21e6, rel=0.01)


def test_an_open_chain_takes_the_supply_off_by_itself() -> None:
    bench = Bench()
    bench.give(Fault.CHAIN_OPEN)
    bench.run(1.0)
    assert bench.world["u"][U_BLEED] == 1.0
    assert bench.y[P_S] < 0.5e6


def test_air_makes_the_oil_soft_by_the_law_of_the_oil() -> None:
    bench = Bench()
    stiff = specific_volume(bench.world["plant"], 5e6)
    bench.give(Fault.AIR_IN_OIL)
    bench.run(PERIOD_S)
    airy = plant(fluid={"free_air": 0.05})
    assert specific_volume(bench.world["plant"], 5e6) == specific_volume(airy, 5e6)
    assert specific_volume_law(bench.world["plant"], 5e6) == specific_volume_law(airy, 5e6)
    assert specific_volume(airy, 5e6)[1] < 1.3 * stiff[1] < 0.0


def test_a_broken_specimen_lets_the_piston_run_to_its_end_stop_and_no_further() -> None:
    bench = Bench(valve=0.1)
    bench.give(Fault.SPECIMEN_BROKEN)
    bench.outputs["valve_command"] = 1.0
    found = np.empty((1200, STATES))
    for k in range(len(found)):
        bench.run(PERIOD_S)
        found[k] = bench.y
    stroke = found[:, X_R] - found[:, X_B]
    assert np.all(np.isfinite(found))
    assert 0.0397 < np.max(stroke) < 0.0409
    assert 128.68e-6 - 2.592e-3 * np.max(stroke) > 0.0
    assert stroke[-1] == pytest.approx(0.0400, abs=1e-4)  # 52 kN on 200e6 N/m
    assert np.all(found[:, [P_1, P_2, P_S]] > 0.0)


def test_a_new_specimen_is_fitted_without_a_blow() -> None:
    bench = Bench(valve=0.1)
    bench.give(Fault.SPECIMEN_BROKEN)
    bench.outputs["valve_command"] = 1.0
    bench.run(0.1)
    bench.outputs["valve_command"] = 0.0
    bench.run(0.05)
    bench.mend(Fault.SPECIMEN_BROKEN)
    read = bench.run(0.2)
    assert np.max(np.abs(read["force_n"])) < 5e3
    assert abs(bench.y[X_2] - bench.y[X_T]) < 1e-3
    assert abs(bench.y[V_2]) < 1e-2


# ---- the books hold while things are broken ----


def shaken(ticks: int) -> Any:
    held = inputs(ticks)
    rng = np.random.default_rng(5)
    held[:, U_VALVE] = 0.3 * np.repeat(rng.uniform(-1, 1, ticks // 10), 10)
    held[:, U_UNIT] = 2e-3 * np.sin(2 * np.pi * 10 * PERIOD_S * np.arange(ticks))
    return held


@pytest.mark.parametrize(
    "fault",
    [
        Fault.VALVE_HARD_OVER,
        Fault.VALVE_STUCK,
        Fault.VALVE_NULL_SHIFT,
        Fault.PUMP_LOSS,
        Fault.SPECIMEN_BROKEN,
        Fault.AIR_IN_OIL,
    ],
    ids=lambda f: f.name,
)
def test_nothing_is_lost_and_nothing_comes_from_nowhere_with_a_fault(fault: Fault) -> None:
    bench = Bench()
    bench.give(fault)
    held = np.empty((600, PLANT_INPUTS))
    commands = shaken(600)
    bench.run(2 * PERIOD_S)
    before = bench.y.copy()
    for k, command in enumerate(commands):
        held[k] = bench.world["u"]
        bench.outputs["valve_command"] = command[U_VALVE]
        bench.outputs["displacement_command_m"] = command[U_UNIT]
        bench.run(PERIOD_S)
    assert max(balance(bench.world["plant"], before, held, steps=32)) < 1e-6


def test_a_blow_on_the_end_stop_loses_just_what_the_stop_takes() -> None:
    loose = plant(unit={"k_tra": 1e5, "c_tra": 0.0})
    held = inputs(600)
    held[:, U_VALVE] = np.where(np.arange(600) < 350, 1.0, -1.0)
    before = pressurised(loose)
    found = states(loose, before, held)
    assert np.max(found[:, X_R] - found[:, X_B]) > 0.0398
    lost = balance(loose, before, held, steps=16)
    assert max(lost) < 1e-6
    stiffer = loose.copy()
    stiffer["end_stop_n_m"] *= 1.01  # a stop that is stiffer than the book's: seen
    assert balance(loose, before, held, states(stiffer, before, held), steps=16).energy > 1e-6


def test_a_piston_on_its_end_stop_stays_where_the_integrator_can_follow() -> None:
    rig_from({"load_actuator": {"end_stop_n_m": 1e9}})
    with pytest.raises(ValueError, match="piston on its end stop"):
        rig_from({"load_actuator": {"end_stop_n_m": 2e9}, "structure": {"m_la_kg": 2.0}})
