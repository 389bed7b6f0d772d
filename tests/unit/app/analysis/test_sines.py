"""Sines with known amplitude, mean, phase and distortion; a fit by scipy; holds in the middle."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.optimize import least_squares

from app.analysis.evidence import Kind, Sine, Stretch
from rtcore.modes import Mode
from tests.unit.app.analysis.made_up import (
    FIRST_TICK,
    PERIOD_S,
    Records,
    cycles,
    measure,
    run_of,
    stretch,
)

Floats = npt.NDArray[np.float64]
AMPLITUDE_N, LAG_DEG = 1800.0, -37.5


def _phase(frequency_hz: float, ticks: npt.ArrayLike, begin_cycles: float = 0.0) -> Floats:
    turned = begin_cycles + frequency_hz * PERIOD_S * np.asarray(ticks, np.float64)
    return np.asarray(2 * np.pi * turned)


def _force(phase: Floats) -> Floats:
    """A mean of 250 N, 1,800 N that lag 37.5°, 3 % of second and 4 % of third harmonic."""
    second, third = 0.03 * np.cos(2 * phase + 1), 0.04 * np.sin(3 * phase)
    first = np.sin(phase + math.radians(LAG_DEG))
    return np.asarray(250 + AMPLITUDE_N * (first + second + third))


def _sine_run(ticks: int, frequency_hz: float, begin_cycles: float = 0.0) -> Records:
    phase = _phase(frequency_hz, np.arange(ticks), begin_cycles)
    return run_of(
        ticks,
        force_command_n=100 + 2000 * np.sin(phase),
        force_n=_force(phase),
        cycle=np.floor(frequency_hz * PERIOD_S * np.arange(ticks) + 1e-9),
    )


@pytest.mark.parametrize("frequency_hz", [0.5, 10.0, 33.7, 97.3, 100.0])
@pytest.mark.parametrize("begin_cycles", [0.0, 0.37])
def test_a_known_sine_is_found(frequency_hz: float, begin_cycles: float) -> None:
    ticks = round(13 / frequency_hz / PERIOD_S)
    program = [cycles(0, ticks, frequency_hz, 2000)]
    values = measure(_sine_run(ticks, frequency_hz, begin_cycles), program).run
    assert values["amplitude_n"] == pytest.approx(AMPLITUDE_N, rel=1e-6)
    assert values["mean_n"] == pytest.approx(250, rel=1e-5)
    assert values["phase_deg"] == pytest.approx(LAG_DEG, abs=1e-4)
    assert values["total_harmonic_distortion_percent"] == pytest.approx(5, rel=1e-5)
    assert values["amplitude_error_percent"] == pytest.approx(-10, rel=1e-5)
    assert values["cycles"] == 13


def test_noise_is_averaged_as_scipy_does() -> None:
    rng = np.random.default_rng(3)
    ticks, frequency_hz = 3333, 17.3  # not a whole number of cycles
    run = _sine_run(ticks, frequency_hz)
    run["force_n"] += rng.normal(0, 200, ticks).astype(np.float32)
    phase = _phase(frequency_hz, np.arange(ticks))

    def apart(p: Floats) -> Any:
        made = p[0] + sum(
            p[2 * k - 1] * np.cos(k * phase) + p[2 * k] * np.sin(k * phase) for k in range(1, 11)
        )
        return made - run["force_n"].astype(np.float64)

    fitted = least_squares(apart, np.zeros(21), method="lm", xtol=1e-12, ftol=1e-12).x
    values = measure(run, [cycles(0, ticks, frequency_hz, 2000)]).run
    assert values["mean_n"] == pytest.approx(fitted[0], rel=1e-5)
    assert values["amplitude_n"] == pytest.approx(math.hypot(fitted[1], fitted[2]), rel=1e-5)
    lag_deg = math.degrees(math.atan2(fitted[1], fitted[2]))
    assert values["phase_deg"] == pytest.approx(lag_deg, abs=1e-3)


@pytest.mark.parametrize("hold_at", [1, 200, 1237, 3999])
@pytest.mark.parametrize("held", [3, 500, 12_345])
def test_a_hold_changes_nothing_that_is_measured_of_a_sine(hold_at: int, held: int) -> None:
    frequency_hz, fade = 10.0, 1000
    frozen = held + min(held, fade) - 1
    ticks = 4000 + frozen
    run = _sine_run(ticks, frequency_hz)  # the oscillator runs on while the load is held
    run["mode"][hold_at : hold_at + held] = Mode.HOLDING
    run["force_n"][hold_at : hold_at + frozen] = 17
    run["force_command_n"][hold_at : hold_at + frozen] = 100
    position = np.concatenate([np.arange(hold_at), np.arange(hold_at, 4000)])
    kept = np.r_[0:hold_at, hold_at + frozen : ticks]
    run["cycle"][kept] = position // 400
    values = measure(run, [cycles(0, 4000, frequency_hz, 2000)]).run
    assert values["amplitude_n"] == pytest.approx(AMPLITUDE_N, rel=1e-6)
    assert values["mean_n"] == pytest.approx(250, rel=1e-5)
    assert values["phase_deg"] == pytest.approx(LAG_DEG, abs=1e-4)
    assert values["total_harmonic_distortion_percent"] == pytest.approx(5, rel=1e-5)
    assert values["cycles"] == 10


def test_stretches_of_the_same_sine_are_one_wherever_their_phases_begin() -> None:
    frequency_hz = 20.0
    parts = [_sine_run(800, frequency_hz, begin) for begin in (0.0, 0.25, 0.6)]
    run = np.concatenate(parts)
    run["tick"] = FIRST_TICK + np.arange(len(run))
    program = [cycles(800 * i, 800 * (i + 1), frequency_hz, 2000) for i in range(3)]
    measured = measure(run, program)
    assert measured.run["phase_deg"] == pytest.approx(LAG_DEG, abs=1e-4)
    assert measured.run["amplitude_n"] == pytest.approx(AMPLITUDE_N, rel=1e-6)
    assert len(measured.sines) == 1


def test_of_several_sines_the_worst_error_is_told_and_each_can_be_had() -> None:
    good, bad = _sine_run(4000, 10.0), _sine_run(4000, 50.0)
    bad["force_n"] *= 0.5
    run = np.concatenate([good, bad])
    run["tick"] = FIRST_TICK + np.arange(len(run))
    program = [cycles(0, 4000, 10.0, 2000), cycles(4000, 8000, 50.0, 2000)]
    measured = measure(run, program)
    assert measured.run["amplitude_n"] is None
    assert measured.run["amplitude_error_percent"] == pytest.approx(-55, rel=1e-5)
    assert [sine.asked.frequency_hz for sine in measured.sines] == [10.0, 50.0]
    assert [sine.amplitude_n for sine in measured.sines] == pytest.approx([1800, 900], rel=1e-6)


def test_harmonics_above_half_the_loop_rate_are_left_out() -> None:
    ticks, frequency_hz = 4000, 800.0  # 1,600 Hz is below 2,000 Hz, 2,400 Hz is not
    phase = _phase(frequency_hz, np.arange(ticks))
    force_n = np.sin(phase) + 0.1 * np.sin(2 * phase)
    run = run_of(ticks, force_command_n=np.sin(phase), force_n=force_n)
    found = measure(run, [cycles(0, ticks, frequency_hz, 1.0)]).run
    assert found["total_harmonic_distortion_percent"] == pytest.approx(10, rel=1e-5)
    above = run_of(ticks, force_command_n=np.sin(1.5 * phase), force_n=np.sin(1.5 * phase))
    found = measure(above, [cycles(0, ticks, 1.5 * frequency_hz, 1.0)]).run
    assert found["amplitude_n"] == pytest.approx(1, rel=1e-6)
    assert found["total_harmonic_distortion_percent"] is None


def test_less_than_a_cycle_is_no_sine() -> None:
    run = _sine_run(390, 10.0)
    values = measure(run, [cycles(0, 4000, 10.0, 2000)]).run
    assert values["amplitude_n"] is None
    assert values["mean_peak_n"] is None
    assert values["cycles"] == 0


def test_peaks_and_valleys_are_those_of_each_whole_cycle() -> None:
    run = _sine_run(4000, 10.0)
    scale = 1 + 0.01 * (np.arange(4000) // 400)
    run["force_n"] = 1000 * np.sin(_phase(10.0, np.arange(4000))) * scale
    values = measure(run, [cycles(0, 4000)]).run
    assert values["mean_peak_n"] == pytest.approx(1045, rel=1e-6)
    assert values["mean_valley_n"] == pytest.approx(-1045, rel=1e-6)
    assert values["highest_peak_n"] == pytest.approx(1090, rel=1e-6)
    assert values["lowest_valley_n"] == pytest.approx(-1090, rel=1e-6)


def test_a_cycle_that_a_gap_interrupts_counts_but_has_no_peak() -> None:
    run = _sine_run(4000, 10.0)
    run["force_n"] = 1000.0 + run["cycle"]
    recorded = np.delete(run, np.arange(450, 700))
    values = measure(recorded, [cycles(0, 4000)]).run
    assert values["cycles"] == 10
    assert values["mean_peak_n"] == pytest.approx(np.mean([1000, *range(1002, 1010)]))


def test_what_is_beyond_the_last_whole_cycle_is_none() -> None:
    run = _sine_run(4100, 10.0)
    run["force_n"] = 1000.0 + run["cycle"]
    program = [cycles(0, 4100), stretch(Kind.LEAD, 4100, 4200)]
    for end in (4100, 4099):
        values = measure(run[:end], program).run
        assert values["cycles"] == 10
        assert values["highest_peak_n"] == 1009


def test_after_a_hold_the_prediction_is_not_compared_until_the_phase_is_its_own_again() -> None:
    from app.analysis.predicted import Predicted

    run = run_of(4499, force_n=100)
    run["mode"][1000:1250] = Mode.HOLDING  # frozen for 250 + 249 ticks, in the cycles
    run["force_n"][1499:2499] = 5000  # goes on out of phase
    program: list[Stretch] = [
        cycles(0, 2000),
        stretch(Kind.COURSE, 2000, 4000, block=1),
    ]
    predicted = [{"program_tick": np.arange(4000), "force_n": np.full(4000, 90.0)}]
    measured = measure(run, program, predicted=Predicted(predicted))
    assert measured.blocks[0]["goodness_of_fit"] == pytest.approx(90)
    assert measured.blocks[1]["goodness_of_fit"] == pytest.approx(90)
    assert program[0].sine == Sine(10.0, 1000.0, 0.0)
