"""The integrator against scipy's Radau at 1e-10, and that it is of the order that it claims."""

import numpy as np
import pytest

from bench.references import HeldPlant, radau, slopes, solver_states
from rtcore.rig.derivatives import derivatives, smooth_sign
from rtcore.rig.plant import FLOWS, STATES, U_BLEED, U_PUMP, U_UNIT, U_VALVE
from tests.unit.rtcore.rig.plants import Floats, cell_force, inputs, plant, pressurised, states

PLANT = plant()


def pushed() -> Floats:
    """A step that drives the valve into its stop, and back through a turn of the piston."""
    held = inputs(60)
    held[2:20, U_VALVE], held[20:40, U_VALVE], held[40:, U_VALVE] = 0.9, -0.4, 0.02
    return held


def moved() -> Floats:
    """The unit leaves while the valve stays."""
    held = inputs(60)
    held[2:, U_UNIT] = 0.01
    held[:, U_VALVE] = 0.03
    return held


def bled() -> Floats:
    """The supply is bled under load."""
    held = inputs(60)
    held[:, U_VALVE] = 0.05
    held[10:, U_BLEED], held[10:, U_PUMP] = 1.0, 0.3e6
    return held


@pytest.mark.slow
@pytest.mark.parametrize("held", [pushed(), moved(), bled()], ids=["pushed", "moved", "bled"])
def test_the_force_is_within_a_twentieth_of_a_percent_of_radau(held: Floats) -> None:
    y = pressurised(PLANT)
    true = cell_force(PLANT, solver_states(radau, PLANT, y, held, 1e-10))
    peak = np.max(np.abs(true))
    assert peak > 500.0
    assert np.max(np.abs(cell_force(PLANT, states(PLANT, y, held)) - true)) < 5e-4 * peak


def test_halving_the_step_divides_the_error_by_sixteen() -> None:
    """On a smooth stretch: no stop, no turn of the piston, the orifice well open."""
    held = inputs(8)
    held[:, U_VALVE] = 0.05 + 0.002 * np.arange(8)
    held[:, U_UNIT] = 0.02
    y = states(PLANT, pressurised(PLANT, 4e6), np.repeat(held[:1], 400, axis=0), 32)[-1]
    true = cell_force(PLANT, states(PLANT, y, held, 128))
    errors = [np.max(np.abs(cell_force(PLANT, states(PLANT, y, held, n)) - true)) for n in (8, 16)]
    assert 12.0 < errors[0] / errors[1] < 22.0


def test_more_steps_change_little_at_the_number_that_the_tick_takes() -> None:
    coarse, fine = (
        cell_force(PLANT, states(PLANT, pressurised(PLANT), pushed(), n)) for n in (4, 64)
    )
    assert np.max(np.abs(coarse - fine)) < 5e-4 * np.max(np.abs(fine))


def test_what_scipy_is_given_are_the_plants_own_equations() -> None:
    held, y = HeldPlant(PLANT), pressurised(PLANT, 3e6)
    held.inputs[:] = pushed()[10]
    q, dy = np.zeros(FLOWS), np.zeros(STATES)
    derivatives(PLANT, y, held.inputs, q, dy)
    assert np.array_equal(held.slopes(0.0, y), dy)
    assert np.array_equal(slopes(y, 0.0, *held.addresses), dy)


@pytest.mark.parametrize("z", [-400.0, -20.0, -1.0, -1e-3, 0.0, 1e-9, 0.3, 5.0, 800.0])
def test_friction_turns_along_a_hyperbolic_tangent(z: float) -> None:
    assert smooth_sign(z) == pytest.approx(np.tanh(z), abs=3e-16)
