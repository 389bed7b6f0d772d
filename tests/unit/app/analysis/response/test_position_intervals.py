"""Intervals of the position response hold the steps of a transducer without noise: against scipy's servo."""

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.signal import TransferFunction, cont2discrete, lfilter

from app.analysis.response.bla import BestLinear, robust
from app.analysis.response.periods import Periods, Realisation
from app.analysis.response.unit_under_test import command_as_it_acts, servo
from app.definitions.multisine import grid_of_list, moving_period_of
from rtcore.rig.parameters import load_rig

RATE_HZ, TICKS = 4000.0, 4000
DRAWS, REALISATIONS = 25, 3
CHANNELS = ("displacement_command_m", "displacement_m")
UNIT, SENSORS = load_rig().unit, load_rig().sensors
STEP_M = SENSORS.displacement_range_m / 2 ** (SENSORS.bits - 1)
LINES = [2.0, 4.0, 6.0, 9.0, 12.0, 17.0, 25.0, 35.0, 50.0, 70.0, 100.0]
GRID = grid_of_list(LINES)


def sampled_servo() -> tuple[Any, Any]:
    """Numerator and denominator of the unit's servo behind a hold."""
    w, zeta = UNIT.omega_t_rad_s, UNIT.zeta_t
    servo = TransferFunction([w**2], [1.0, 2 * zeta * w, w**2])
    b, a, _ = cont2discrete((servo.num, servo.den), 1 / RATE_HZ)
    return b.ravel(), a


def measured(number: int) -> Realisation:
    """Three periods of a realisation, rounded to the transducer's steps, the first to settle."""
    wave = 0.001 * moving_period_of(replace(GRID, realisation=number)).values[:-1]
    moved = lfilter(*sampled_servo(), np.tile(wave, 3))
    read = np.round(moved / STEP_M) * STEP_M
    command = np.roll(np.tile(wave, 3), -1)  # that of a tick acts in the next
    periods = Periods(CHANNELS, TICKS, list(GRID.lines), settle=1)
    periods.take(np.arange(3 * TICKS), dict(zip(CHANNELS, (command, read), strict=True)))
    found = periods.realisation()
    assert found is not None
    return command_as_it_acts(found, RATE_HZ, TICKS)


def drawn(draw: int) -> BestLinear:
    several = [measured(1 + draw * REALISATIONS + i) for i in range(REALISATIONS)]
    return robust(several, *CHANNELS, np.array(GRID.lines), 1.0)


def within(ends: npt.NDArray[Any], true: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    return np.asarray((ends[:, 0] <= true) & (true <= ends[:, 1]))


def test_they_hold_the_truth_nineteen_times_of_twenty() -> None:
    true = servo(load_rig(), np.array(LINES))
    draws = [drawn(i) for i in range(DRAWS)]
    gains = np.mean([within(best.gain_95, np.abs(true)) for best in draws])
    phases = np.mean([within(best.phase_95_deg, np.angle(true, deg=True)) for best in draws])
    assert 0.92 < gains < 0.98
    assert 0.92 < phases < 0.98
    apart = np.array([best.gain / true for best in draws])
    assert np.abs(np.abs(apart) - 1).max() < 0.01
    assert np.abs(np.angle(apart, deg=True)).max() < 1
