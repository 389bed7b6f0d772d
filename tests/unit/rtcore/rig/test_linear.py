"""The linearised plant against its own springs and masses, against itself in time, and in closed forms."""

import numpy as np
import pytest

from rtcore.rig.linear import (
    FORCE,
    FORCE_READ,
    OUTPUTS,
    UNIT_VELOCITY,
    VELOCITY_READ,
    StateSpace,
    linearise,
    settle,
)
from rtcore.rig.plant import (
    INPUTS,
    P_1,
    P_2,
    STATES,
    U_PUMP,
    U_UNIT,
    U_VALVE,
    V_1,
    V_2,
    V_B,
    V_R,
    X_1,
    X_B,
    X_R,
    X_T,
    Y_V,
)
from tests.unit.rtcore.rig.plants import (
    PERIOD_S,
    PUMP_PA,
    Floats,
    cell_force,
    inputs,
    plant,
    pressurised,
    states,
)

PLANT = plant()
BIAS = 0.05


def held(valve: float = 0.0) -> Floats:
    u: Floats = inputs(1)[0]
    u[U_VALVE] = valve
    return u


@pytest.fixture(scope="module")
def at_bias() -> tuple[Floats, StateSpace]:
    """(state at rest under a bias of the valve, the plant linearised there)."""
    y = settle(PLANT, pressurised(PLANT), held(BIAS))
    return y, linearise(PLANT, y, held(BIAS))


def test_the_jacobian_holds_the_springs_and_masses() -> None:
    a = linearise(PLANT, pressurised(PLANT), held()).a
    assert a[V_1, X_R] == pytest.approx(800e6 / 8.0, rel=1e-6)
    assert a[V_1, X_1] == pytest.approx(-(800e6 + 300e6) / 8.0, rel=1e-6)
    assert a[V_2, X_T] == pytest.approx(60e6 / 5.0, rel=1e-6)
    assert a[V_2, V_1] == pytest.approx(4000.0 / 5.0, rel=1e-6)
    assert a[V_B, X_B] == pytest.approx(-150e6 / 40.0, rel=1e-6)
    assert a[V_R, P_1] == pytest.approx(2.592e-3 / 7.0, rel=1e-6)
    assert a[V_B, P_1] == pytest.approx(-2.592e-3 / 40.0, rel=1e-6)
    friction = 50.0 / 1e-3 + 400.0
    assert a[V_R, V_R] == pytest.approx(-(friction + 4000.0) / 7.0, rel=1e-4)
    assert a[X_R, V_R] == pytest.approx(1.0)


def test_the_arguments_are_left_as_they_were() -> None:
    y, u = pressurised(PLANT), held(0.1)
    linearise(PLANT, y, u)
    assert np.array_equal(y, pressurised(PLANT))
    assert np.array_equal(u, held(0.1))


def test_at_no_frequency_the_force_follows_the_static_law(
    at_bias: tuple[Floats, StateSpace],
) -> None:
    """Slope of A Δp between two settled states, by the non-linear plant."""
    y, space = at_bias
    drops = []
    for valve in (BIAS - 1e-4, BIAS + 1e-4):
        settled = settle(PLANT, y, held(valve))
        drops.append(settled[P_1] - settled[P_2])
    slope = 2.592e-3 * (drops[1] - drops[0]) / 2e-4
    assert space.response(1e-4)[FORCE, U_VALVE].real == pytest.approx(slope, rel=1e-4)


def test_the_units_servo_is_its_second_order_lag(at_bias: tuple[Floats, StateSpace]) -> None:
    omega, zeta = 75.39822368615503, 0.8
    for frequency_hz in (1.0, 4.0, 12.0, 40.0):
        s = 2j * np.pi * frequency_hz
        wanted = s * omega**2 / (s**2 + 2 * zeta * omega * s + omega**2)
        found = at_bias[1].response(frequency_hz)[UNIT_VELOCITY, U_UNIT]
        assert found == pytest.approx(wanted, rel=1e-6)


def test_the_chains_of_load_cell_and_lvt_are_their_lags(
    at_bias: tuple[Floats, StateSpace],
) -> None:
    omega, zeta = 2 * np.pi * 2000, 0.7
    for frequency_hz in (10.0, 500.0, 2000.0):
        s = 2j * np.pi * frequency_hz
        chain = omega**2 / (s**2 + 2 * zeta * omega * s + omega**2)
        found = at_bias[1].response(frequency_hz)
        assert found[FORCE_READ, U_VALVE] == pytest.approx(chain * found[FORCE, U_VALVE], rel=1e-6)


def test_sampling_a_first_order_lag_gives_its_closed_form() -> None:
    """x' = -a x + a u held for T: x⁺ = e^(-aT) x + (1 - e^(-aT)) u."""
    rate = 300.0
    lag = StateSpace(np.array([[-rate]]), np.array([[rate]]), np.ones((1, 1)))
    sampled = lag.sampled(PERIOD_S)
    decay = np.exp(-rate * PERIOD_S)
    assert sampled.a[0, 0] == pytest.approx(decay)
    assert sampled.b[0, 0] == pytest.approx(1 - decay)
    z = np.exp(2j * np.pi * 50.0 * PERIOD_S)
    assert sampled.response(50.0)[0, 0] == pytest.approx((1 - decay) / (z - decay))
    assert lag.response(50.0)[0, 0] == pytest.approx(rate / (2j * np.pi * 50.0 + rate))


@pytest.mark.parametrize("frequency_hz", [4.0, 36.0, 100.0])
def test_a_tiny_sine_goes_through_the_plant_as_the_linear_one_says(
    at_bias: tuple[Floats, StateSpace], frequency_hz: float
) -> None:
    """Within 0.02 dB and 0.1°, delay and hold included; half a second measured after one to settle."""
    y, space = at_bias
    ticks = 6000
    phase = 2 * np.pi * frequency_hz * PERIOD_S * np.arange(ticks)
    driven = np.tile(held(BIAS), (ticks, 1))
    driven[:, U_VALVE] += 1e-6 * np.sin(phase)
    found = states(PLANT, y, driven)[4000:]
    wave = np.exp(-1j * phase[4000:])
    for output, values in (
        (FORCE, cell_force(PLANT, found)),
        (VELOCITY_READ, found[:, Y_V]),
    ):
        # A state is that at the end of its tick, one tick on.
        z = np.exp(2j * np.pi * frequency_hz * PERIOD_S)
        measured = 2j * np.mean((values - np.mean(values)) * wave) / 1e-6 / z
        ratio = measured / space.sampled(PERIOD_S).response(frequency_hz)[output, U_VALVE]
        assert abs(20 * np.log10(abs(ratio))) < 0.02
        assert abs(np.angle(ratio, deg=True)) < 0.1


def test_settling_comes_to_rest() -> None:
    y = settle(PLANT, pressurised(PLANT, 5e6), held(0.02))
    again = settle(PLANT, y, held(0.02), duration_s=0.5)
    assert again == pytest.approx(y, rel=1e-9, abs=1e-6)
    assert y.shape == (STATES,)


def test_the_shapes_are_those_that_are_told(at_bias: tuple[Floats, StateSpace]) -> None:
    space = at_bias[1]
    assert space.a.shape == (STATES, STATES)
    assert space.b.shape == (STATES, INPUTS)
    assert space.response(1.0).shape == (OUTPUTS, INPUTS)
    assert space.sampled(PERIOD_S).response(1.0).shape == (OUTPUTS, INPUTS)
    assert held()[U_PUMP] == PUMP_PA
