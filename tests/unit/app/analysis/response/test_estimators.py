"""Estimators of whole records against closed forms, scipy's filters and python-control."""

from dataclasses import replace

import control
import numpy as np
import numpy.typing as npt
import pytest
from scipy import signal

from app.analysis.force_loop import ForceLoop
from app.analysis.linear import linear_rig
from app.analysis.response.bla import fast, robust
from app.analysis.response.extremes import find_extremes
from app.analysis.response.margins import margins_of, open_loop
from app.analysis.response.periods import Periods, Realisation
from app.analysis.response.slow_cycles import slow_cycles, unit_deformation
from app.analysis.response.spectral import Against, spectral_response
from app.analysis.response.swept import swept_response
from app.analysis.response.unit_under_test import held_a_tick_later, unit_weights
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from rtcore.control.response import shift
from rtcore.rig.linear import FORCE_READ, UNIT_VELOCITY, VELOCITY_READ
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import U_UNIT, U_VALVE

PERIOD_S = 250e-6
LOW_PASS = signal.butter(2, 60.0, fs=1 / PERIOD_S)
RIG = load_rig()


def _true(frequencies_hz: npt.NDArray[np.float64]) -> npt.NDArray[np.complex128]:
    return np.asarray(signal.freqz(*LOW_PASS, worN=frequencies_hz, fs=1 / PERIOD_S)[1])


def test_peak_dip_and_corners_are_those_of_python_control() -> None:
    system = control.tf([1.0], [1 / 200.0**2, 0.4 / 200.0, 1.0])
    frequencies_hz = np.geomspace(2, 100, 60)
    response = system(2j * np.pi * frequencies_hz)
    found = find_extremes(frequencies_hz[::-1], response[::-1])
    fine = 2 * np.pi * np.linspace(2, 100, 200_000)
    size = np.abs(system(1j * fine))
    assert found.peak is not None
    assert found.peak.frequency_hz == pytest.approx(fine[size.argmax()] / 2 / np.pi, rel=5e-3)
    assert found.peak.gain_db == pytest.approx(20 * np.log10(size.max()), abs=0.01)
    corner_hz = fine[np.flatnonzero(size > np.sqrt(0.5))[-1]] / 2 / np.pi
    assert found.minus_3_db_hz == pytest.approx(corner_hz, rel=2e-3)
    assert found.minus_90_deg_hz == pytest.approx(200 / 2 / np.pi, rel=2e-3)
    assert found.dip is None


def test_a_flat_response_has_no_extremes() -> None:
    assert find_extremes([1, 2, 4, 8], [1, 1.0001, 1, 1]) == (None, None, None, None)


def _like_the_papers(hz: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """+3.6 dB at 35 Hz, −2 dB at 85 Hz, rolling off from 200 Hz, nothing let through at 320 Hz, up again."""
    dented = 3.6 * np.exp(-((np.log2(hz / 35) / 0.6) ** 2)) - 2 * np.exp(
        -((np.log2(hz / 85) / 0.5) ** 2)
    )
    fallen = -10 * np.log10(1 + (hz / 200) ** 8) - 20 * np.exp(-((np.log2(hz / 320) / 0.05) ** 2))
    again = 31 * np.exp(-((np.log2(hz / 590) / 0.2) ** 2))
    return np.asarray(10 ** ((dented + fallen + again) / 20))


@pytest.mark.parametrize("to_hz", [100, 150, 300, 400, 1000])
def test_peak_and_dip_are_those_of_the_band_however_far_it_is_measured(to_hz: float) -> None:
    hz = np.geomspace(1, to_hz, 400)
    found = find_extremes(hz, _like_the_papers(hz))
    assert found.peak is not None
    assert found.dip is not None
    assert found.peak == pytest.approx((35, 3.6), rel=0.02)
    assert found.dip == pytest.approx((85, -2.0), rel=0.02)


def test_a_dip_below_the_band_s_edge_is_one_where_it_comes_up_again() -> None:
    hz = np.geomspace(1, 200, 300)
    found = find_extremes(hz, 10 ** (-12 * np.exp(-((np.log2(hz / 60) / 0.3) ** 2)) / 20))
    assert found.dip == pytest.approx((60, -12), rel=0.01)
    assert found.peak is None


@pytest.mark.parametrize("load_hz", [None, 4.0])
def test_the_open_loop_measured_in_the_closed_one_is_that_of_the_linear_rig(
    load_hz: float | None,
) -> None:
    gains, space = to_record(ControllerSettings()), linear_rig(RIG, 5000.0)
    frequencies_hz = np.geomspace(5, 400, 200)
    sampled = space.sampled(PERIOD_S)
    held = np.array([sampled.response(f)[:, U_VALVE] / shift(f, PERIOD_S) for f in frequencies_hz])
    plant, motion = held[:, FORCE_READ], held[:, VELOCITY_READ]
    loop = open_loop(frequencies_hz, plant, motion, gains, PERIOD_S, load_hz)
    true = ForceLoop(space, gains, PERIOD_S, load_hz)
    assert loop == pytest.approx(np.array([true.open_loop(f) for f in frequencies_hz]), rel=1e-9)
    found, wanted = margins_of(frequencies_hz, loop), true.margins()
    assert found.crossover_hz == pytest.approx(wanted.crossover_hz, rel=2e-3)
    assert found.phase_deg == pytest.approx(wanted.phase_deg, abs=0.1)
    assert found.gain_db == pytest.approx(wanted.gain_db, abs=0.02)
    assert found.worst_sensitivity == pytest.approx(wanted.worst_sensitivity, rel=2e-3)


def test_margins_are_those_of_python_control() -> None:
    system = control.tf([40_000.0], [1.0, 120.0, 4000.0, 0.0])
    frequencies_hz = np.geomspace(0.3, 60, 400)
    found = margins_of(frequencies_hz, system(2j * np.pi * frequencies_hz))
    gain, phase_deg, _, crossover = control.margin(system)
    assert found.gain_db == pytest.approx(20 * np.log10(gain), abs=0.01)
    assert found.phase_deg == pytest.approx(phase_deg, abs=0.05)
    assert found.crossover_hz == pytest.approx(crossover / 2 / np.pi, rel=1e-3)


@pytest.mark.parametrize(
    ("against", "side"), [(Against.INPUT, "output"), (Against.OUTPUT, "input")]
)
def test_averages_against_the_clean_side_are_not_biased(against: Against, side: str) -> None:
    rng = np.random.default_rng(1)
    u = rng.normal(size=400_000)
    y = signal.lfilter(*LOW_PASS, u)
    if side == "output":
        y = y + rng.normal(0, 0.02, len(u))
    else:
        u = u + rng.normal(0, 0.3, len(u))
    curve = spectral_response(u, y, PERIOD_S, 8000, against)
    near = curve.frequencies_hz < 100
    low, high = curve.gain_95[near].T
    true = np.abs(_true(curve.frequencies_hz[near]))
    assert np.mean((low <= true) & (true <= high)) == pytest.approx(0.95, abs=0.04)
    assert np.mean(np.abs(curve.gain[near]) / true) == pytest.approx(1, abs=0.01)


def test_coherence_is_that_of_scipy() -> None:
    rng = np.random.default_rng(2)
    u = rng.normal(size=40_000)
    y = signal.lfilter(*LOW_PASS, u) + rng.normal(0, 0.1, len(u))
    curve = spectral_response(u, y, PERIOD_S, 2000)
    _, theirs = signal.coherence(u, y, 1 / PERIOD_S, "hann", 2000)
    assert curve.coherence == pytest.approx(theirs[1:-1], abs=1e-6)


def test_a_sweep_tells_the_response_exactly_where_there_is_no_noise() -> None:
    ticks = 40_000
    sweep = np.sin(2 * np.pi * PERIOD_S * np.cumsum(np.geomspace(1, 150, ticks)))
    sweep *= signal.windows.tukey(ticks, 0.05)
    frequencies_hz = np.geomspace(3, 80, 12)
    found = swept_response(sweep, signal.lfilter(*LOW_PASS, sweep), PERIOD_S, frequencies_hz)
    assert found.gain == pytest.approx(_true(frequencies_hz), rel=1e-5)
    with pytest.raises(ValueError, match="not enough"):
        swept_response(sweep[:20], sweep[:20], PERIOD_S, frequencies_hz)


@pytest.mark.parametrize("rise", [0.0, 200.0])
def test_what_a_sweep_excites_at_its_very_end_is_told_where_it_comes_to_rest(rise: float) -> None:
    ticks = 40_000
    sweep = np.sin(2 * np.pi * PERIOD_S * np.cumsum(np.geomspace(1, 150, ticks)))
    sweep *= signal.windows.tukey(ticks, 0.05)
    sweep += rise * np.clip(np.linspace(-0.01, 1.0, ticks) / 0.002, 0.0, 1.0)  # to another level
    output = signal.lfilter(*LOW_PASS, sweep)
    output += np.random.default_rng(3).normal(0.0, 1e-3, ticks)
    frequencies_hz = np.array([100.0, 115.0, 125.0, 135.0])
    found = swept_response(sweep, output, PERIOD_S, frequencies_hz, at_rest=True)
    assert found.gain == pytest.approx(_true(frequencies_hz), rel=5e-3)
    assert np.isnan(swept_response(sweep, output, PERIOD_S, frequencies_hz).gain[-2:]).all()


SIZE = 2000
ODD = np.arange(1, 60, 2)
LEFT_OUT = ODD[3::4]
EXCITED = np.setdiff1d(ODD, LEFT_OUT)


def _realisation(seed: int, cubic: float, noise: float) -> Realisation:
    rng = np.random.default_rng(seed)
    phase = 2 * np.pi * np.outer(EXCITED, np.arange(SIZE)) / SIZE
    u = 0.4 * np.cos(phase + rng.uniform(0, 2 * np.pi, len(EXCITED))[:, None]).sum(axis=0)
    periods = Periods(("u", "y"), SIZE, ODD.tolist(), settle=1)
    for k in range(6):
        y = u + cubic * u**3 + rng.normal(0, noise, SIZE)
        at = np.arange(k * SIZE, (k + 1) * SIZE)
        for part in np.array_split(np.arange(SIZE), 3):
            periods.take(at[part], {"u": u[part], "y": y[part]})
    made = periods.realisation()
    assert made is not None
    assert made.periods == 5
    return made


def test_noise_and_distortion_are_told_apart() -> None:
    period_s, noise = SIZE * PERIOD_S, 0.2
    drawn = [_realisation(s, 0.02, noise) for s in range(40)]
    found = robust(drawn, "u", "y", EXCITED, period_s)
    met = 0.75 * 0.4**2 * (2 * len(EXCITED) - 1)
    assert np.mean(found.gain) == pytest.approx(1 + 0.02 * met, abs=0.002)
    per_line = 2 * noise * np.sqrt(1 / SIZE) / np.sqrt(5) / 0.4  # amplitude of a line's noise
    assert np.sqrt(np.mean(found.noise_variance) * 40) == pytest.approx(per_line, rel=0.1)
    quick = fast(drawn, "u", "y", EXCITED, LEFT_OUT, period_s)
    levels = [np.mean(f.nonlinear_variance) for f in (quick, found)]
    assert levels[0] == pytest.approx(levels[1], rel=0.2)
    linear = robust([_realisation(s, 0.0, noise) for s in range(40)], "u", "y", EXCITED, period_s)
    assert np.mean(linear.nonlinear_variance) < 0.02 * levels[1]


def test_of_one_period_no_coherence_is_known() -> None:
    drawn = _realisation(1, 0.0, 0.2)
    single = replace(drawn, periods=1)
    known, unknown = (robust([r], "u", "y", EXCITED, 0.5) for r in (drawn, single))
    assert np.isnan(unknown.coherence).all()
    assert np.isinf(unknown.gain_95[:, 1]).all()
    assert ((known.coherence > 0) & (known.coherence < 1)).all()


def test_a_period_that_misses_ticks_is_left_out() -> None:
    periods = Periods(("u",), 100, [1])
    at = np.delete(np.arange(500), 250)
    periods.take(at, {"u": np.cos(2 * np.pi * at / 100)})
    made = periods.realisation()
    assert made is not None
    assert made.periods == 4
    assert made.of("u") == pytest.approx([1.0])


@pytest.mark.parametrize("frequency_hz", [1.0, 35.0, 100.0])
def test_the_unit_is_seen_through_the_chain_that_the_plant_has(frequency_hz: float) -> None:
    """From the plant's own equations, linearised: load cell and LVT to a motion of the unit."""
    moved = linear_rig(RIG, 5000.0).response(frequency_hz)[:, U_UNIT]
    s = 2j * np.pi * frequency_hz
    channels = np.array([moved[FORCE_READ], moved[VELOCITY_READ], moved[UNIT_VELOCITY] / s])
    force, deformation = unit_weights(RIG, frequency_hz) @ channels
    assert force / deformation == pytest.approx(RIG.unit.k_tra + s * RIG.unit.c_tra, rel=1e-4)


def test_what_is_held_a_tick_later_lags_by_a_tick_and_a_half() -> None:
    sampled = np.exp(-2j * np.pi * 80.0 * PERIOD_S) * np.mean(
        np.exp(-2j * np.pi * 80.0 * PERIOD_S * (np.arange(10_000) + 0.5) / 10_000)
    )
    assert held_a_tick_later(np.array([80.0]), PERIOD_S)[0] == pytest.approx(sampled, rel=1e-6)


@pytest.mark.parametrize("backlash_m", [0.0, 40e-6])
def test_stiffness_hysteresis_and_backlash_of_slow_cycles(backlash_m: float) -> None:
    ticks, friction_m = 4000, 5e-6
    phase = 2 * np.pi * np.arange(3 * ticks) / ticks
    force = 20e3 * np.sin(phase)
    way = force / 60e6 - friction_m * np.sign(np.cos(phase)) + backlash_m / 2 * np.sign(force)
    found = slow_cycles(force.reshape(3, -1), -(-way).reshape(3, -1))
    assert found.stiffness_n_m == pytest.approx(60e6, rel=5e-3)
    assert found.backlash_m == pytest.approx(backlash_m, abs=2e-7)
    assert found.hysteresis_j == pytest.approx(4 * friction_m * 20e3, rel=1e-2)
    assert found.cycles == 3
    with pytest.raises(ValueError, match="push and pull"):
        slow_cycles(np.abs(force).reshape(3, -1), way.reshape(3, -1))


def test_deformation_comes_from_rod_and_springs_however_the_velocity_wanders() -> None:
    ticks = 4000
    phase = 2 * np.pi * np.arange(2 * ticks) / ticks
    force, part = 10e3 * np.sin(phase), RIG.structure
    yields = 1 / part.k_pl + 1 / part.k_lc + 1 / part.k_2 + 1 / RIG.unit.k_tra
    velocity = 10e3 * yields * np.cos(phase) * 2 * np.pi / (ticks * PERIOD_S) + 1e-4
    loads, found = unit_deformation(force, velocity, 0 * force, ticks, PERIOD_S, RIG)
    assert slow_cycles(loads, found).stiffness_n_m == pytest.approx(RIG.unit.k_tra, rel=1e-3)
