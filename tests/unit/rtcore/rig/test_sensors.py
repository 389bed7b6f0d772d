"""Converters: steps, ends and what the loop is given of the plant's state."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.io import INPUTS
from rtcore.rig.parameters import rig_from
from rtcore.rig.plant import P_1, P_2, P_S, X_S, X_T, Y_F, Y_V
from rtcore.rig.sensors import quantise, read_sensors
from rtcore.rig.world import make_world

HALF = 2.0**15
values = st.floats(-1e5, 1e5)
steps = st.floats(1e-6, 10.0)


@given(values, steps)
def test_a_reading_is_a_whole_number_of_steps_and_within_half_a_step(x: float, lsb: float) -> None:
    code = quantise(x, lsb, HALF) / lsb
    assert code == pytest.approx(round(code), abs=1e-6)
    if -HALF * lsb <= x <= (HALF - 1) * lsb:
        assert abs(quantise(x, lsb, HALF) - x) <= 0.5 * lsb * (1 + 1e-9)


@given(values, values, steps)
def test_a_converter_keeps_the_order(a: float, b: float, lsb: float) -> None:
    low, high = sorted((a, b))
    assert quantise(low, lsb, HALF) <= quantise(high, lsb, HALF)


@given(values, steps)
def test_reading_twice_changes_nothing(x: float, lsb: float) -> None:
    once = quantise(x, lsb, HALF)
    assert quantise(once, lsb, HALF) == once


def test_a_converter_ends_where_its_codes_do() -> None:
    lsb = 60e3 / HALF
    assert quantise(1e6, lsb, HALF) == 60e3 - lsb
    assert quantise(-1e6, lsb, HALF) == -60e3
    assert quantise(math.inf, lsb, HALF) == 60e3 - lsb


def test_what_is_no_number_stays_none() -> None:
    assert math.isnan(quantise(math.nan, 0.1, HALF))


@given(values)
def test_a_step_of_zero_is_an_ideal_converter(x: float) -> None:
    assert quantise(x, 0.0, HALF) == x


def read(**noise: float) -> tuple[Any, Any]:
    """(rig as one record, what the loop is given) for a state with a value of its own everywhere."""
    world = make_world(rig_from({"sensors": noise}), seed=3)[0]
    y = world["y"]
    y[[Y_F, Y_V, X_T, P_1, P_2, P_S]] = 12_345.678, -0.1234567, 0.0123456, 5.4e6, 3.2e6, 20.9e6
    y[X_S] = 0.91e-3  # beyond its stroke, against the stop
    inputs = np.zeros(1, INPUTS)[0]
    read_sensors(world["sensors"], world["plant"], world["noise"], y, inputs)
    return world, inputs


def test_the_loop_reads_the_plant_within_half_a_step() -> None:
    _, inputs = read(force_noise_n=0.0, velocity_noise_m_s=0.0)
    for name, value, full_scale in (
        ("force_n", 12_345.678, 60e3),
        ("velocity_m_s", -0.1234567, 0.5),
        ("displacement_m", 0.0123456, 0.035),
        ("pressure_1_pa", 5.4e6, 35e6),
        ("pressure_2_pa", 3.2e6, 35e6),
        ("supply_pressure_pa", 20.9e6, 35e6),
        ("spool_position", 1.1375, 1.0),  # the spool is seen beyond full scale
    ):
        assert inputs[name] == pytest.approx(value, abs=0.501 * full_scale / HALF), name
        assert inputs[name] != value


def test_noise_is_on_force_and_velocity_alone() -> None:
    _, quiet = read(force_noise_n=0.0, velocity_noise_m_s=0.0)
    _, noisy = read(force_noise_n=80.0, velocity_noise_m_s=2e-3)
    differ = {name for name in INPUTS.names or () if quiet[name] != noisy[name]}
    assert differ == {"force_n", "velocity_m_s"}


def test_noise_has_the_size_that_was_asked_for() -> None:
    world, inputs = read()
    force, velocity = [], []
    for _ in range(4000):
        read_sensors(world["sensors"], world["plant"], world["noise"], world["y"], inputs)
        force.append(float(inputs["force_n"]))
        velocity.append(float(inputs["velocity_m_s"]))
    assert np.std(force) == pytest.approx(8.0, rel=0.05)
    assert np.mean(force) == pytest.approx(12_345.678, abs=0.6)
    assert np.std(velocity) == pytest.approx(0.2e-3, rel=0.05)
