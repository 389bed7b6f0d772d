"""Measurements of made-up runs, whose values are known beforehand."""

import math

import numpy as np
import pytest

from app.analysis.acceptance import Verdict, judge, overall
from app.analysis.evidence import Kind
from app.analysis.goodness import goodness_of_fit
from app.analysis.measurements import MEASUREMENTS
from app.analysis.predicted import Predicted
from app.analysis.walk import Columns
from rtcore.modes import Mode
from tests.unit.app.analysis.made_up import PERIOD_S, cycles, measure, run_of, step, stretch


def test_errors_are_taken_over_counted_cycles_only() -> None:
    error_n = np.full(1600, 900.0)  # while it tapers
    error_n[200:600] = 30.0
    error_n[800:1200] = -40.0
    program = [
        stretch(Kind.LEAD, 0, 200),
        cycles(200, 600),
        stretch(Kind.COURSE, 600, 800),
        cycles(800, 1200),
        stretch(Kind.LEAD, 1200, 1600),
    ]
    values = measure(run_of(1600, force_error_n=error_n), program).run
    assert values["force_error_rms_n"] == pytest.approx(math.sqrt((30**2 + 40**2) / 2))
    assert values["force_error_peak_n"] == 40


def test_a_block_without_cycles_is_measured_over_holds_ramps_and_steps_but_not_lead_ins() -> None:
    error_n = [9, 9, 3, -4, 0, 0, 7, 7]
    program = [stretch(Kind.LEAD, 0, 2), stretch(Kind.COURSE, 2, 6), cycles(6, 8, block=1)]
    measured = measure(run_of(8, force_error_n=error_n), program)
    assert measured.blocks[0]["force_error_rms_n"] == 2.5
    assert measured.blocks[0]["force_error_peak_n"] == 4
    assert measured.blocks[1]["force_error_rms_n"] == 7
    assert measured.run["force_error_rms_n"] == 7
    course = measure(run_of(8, force_error_n=error_n), program[:2]).run
    assert course["force_error_rms_n"] == 2.5


def test_peaks_and_saturation_are_taken_over_the_whole_run() -> None:
    run = run_of(
        4,
        force_n=[100, -900, 3, 0],
        displacement_m=[0.001, -0.002, 0, 0],
        velocity_m_s=[0, 0.25, -0.5, 0],
        valve_command=[0.5, -0.5, 0.49, 0],
    )
    program = [stretch(Kind.LEAD, 0, 2), stretch(Kind.COURSE, 2, 4)]
    values = measure(run, program, valve_limit=0.5).run
    assert values["peak_force_n"] == 900
    assert values["peak_displacement_m"] == pytest.approx(0.002)
    assert values["peak_velocity_m_s"] == 0.5
    assert values["valve_saturation_share"] == 0.5
    assert measure(run, program).run["valve_saturation_share"] == 0


@pytest.mark.parametrize("after", [Mode.STOPPING, Mode.TRIPPED])
def test_what_follows_the_program_is_not_measured(after: Mode) -> None:
    run = run_of(10, force_n=[1] * 6 + [99] * 4)
    run["mode"][8:] = after
    assert measure(run, [stretch(Kind.COURSE, 0, 6)]).run["peak_force_n"] == 1


def test_a_stop_in_the_middle_ends_what_is_measured() -> None:
    run = run_of(10, force_n=[1] * 6 + [99] * 4)
    run["mode"][6:] = Mode.STOPPING
    assert measure(run, [stretch(Kind.COURSE, 0, 100)]).run["peak_force_n"] == 1


def test_goodness_needs_a_prediction_and_compares_the_counted_cycles() -> None:
    rng = np.random.default_rng(7)
    force_n = (2000 * np.sin(np.arange(2000)) + rng.normal(0, 9, 2000)).astype(np.float32)
    predicted_n = (1900 * np.sin(np.arange(2000))).astype(np.float32)
    program = [stretch(Kind.LEAD, 0, 400), cycles(400, 1600), stretch(Kind.LEAD, 1600, 2000)]
    run = run_of(2000, force_n=force_n)
    assert measure(run, program).run["goodness_of_fit"] is None
    halves: list[Columns] = [
        {"program_tick": np.arange(begin, end), "force_n": predicted_n[begin:end]}
        for begin, end in ((0, 700), (700, 1500))
    ]
    found = measure(run, program, predicted=Predicted(halves)).run["goodness_of_fit"]
    expected = goodness_of_fit(force_n[400:1500], predicted_n[400:1500])
    assert found == pytest.approx(expected, abs=1e-9)


def test_the_worst_of_all_steps_is_measured() -> None:
    force_n = np.zeros(300)
    force_n[10:100] = 1100  # overshoot 10 %
    force_n[100:110] = 1000
    force_n[110:200] = -600  # 0 to -500: overshoot 20 %
    force_n[200:] = 0
    steps = [step(0, 110, 0, 1000), step(110, 200, 0, -500, block=1)]
    measured = measure(run_of(300, force_n=force_n), steps)
    assert measured.run["step_overshoot_percent"] == pytest.approx(20)
    assert measured.blocks[0]["step_overshoot_percent"] == pytest.approx(10)
    assert measured.run["step_settling_s"] is not None
    assert math.isnan(measured.run["step_settling_s"])  # the second never settles


def test_a_step_that_changes_nothing_is_none() -> None:
    assert measure(run_of(5), [step(0, 5, 100, 100)]).run["step_rise_s"] is None


def test_of_a_ramp_the_delay_is_measured() -> None:
    time_s = np.arange(4000) * PERIOD_S
    delay_s = 0.0032
    setpoint_n, force_n = 5000 * time_s**2, 5000 * (time_s - delay_s) ** 2
    force_n[time_s < delay_s] = 0
    run = run_of(
        4000, force_command_n=setpoint_n, force_n=force_n, force_error_n=setpoint_n - force_n
    )
    values = measure(run, [stretch(Kind.COURSE, 0, 4000)]).run
    assert values["delay_s"] == pytest.approx(delay_s, rel=0.01)
    still = measure(run_of(10), [stretch(Kind.COURSE, 0, 10)]).run
    assert still["delay_s"] is None


def test_where_there_is_nothing_to_measure_there_is_no_value() -> None:
    values = measure(run_of(10), [stretch(Kind.COURSE, 0, 10)]).run
    assert set(values) == set(MEASUREMENTS)
    for name in ("step_overshoot_percent", "amplitude_n", "mean_peak_n", "cycles"):
        assert values[name] is None
    nothing = measure(run_of(0), [stretch(Kind.COURSE, 0, 10)])
    assert set(nothing.run) == set(MEASUREMENTS)
    assert set(nothing.run.values()) == {None}
    assert nothing.blocks == {}


def test_a_run_that_ends_before_its_first_cycle_has_a_peak_but_no_error() -> None:
    run = run_of(100, force_n=np.full(100, -70.0), force_error_n=np.full(100, 900.0))
    values = measure(run, [stretch(Kind.COURSE, 0, 200), cycles(200, 600)]).run
    assert values["peak_force_n"] == 70
    assert values["force_error_rms_n"] is None
    assert values["force_error_peak_n"] is None
    assert values["cycles"] == 0


def test_a_load_cell_that_gives_no_number_is_seen_in_every_figure_of_the_force() -> None:
    force_n = np.full(2000, 100.0)
    force_n[1234] = math.nan
    run = run_of(2000, force_n=force_n, force_error_n=-force_n, cycle=np.arange(2000) // 400)
    values = measure(run, [cycles(0, 2000)]).run
    for name in ("force_error_rms_n", "force_error_peak_n", "peak_force_n", "amplitude_n"):
        value = values[name]
        assert value is not None, name
        assert math.isnan(value), name
        assert judge(value, None, 1e9) is Verdict.FAIL


def test_finished_are_the_blocks_that_were_played_to_their_last_tick() -> None:
    program = [
        stretch(Kind.COURSE, 0, 10),
        stretch(Kind.COURSE, 10, 20, block=1),
        stretch(Kind.COURSE, 20, 30, block=1),
    ]
    assert measure(run_of(9), program).finished == set()
    assert measure(run_of(10), program).finished == {0}
    assert measure(run_of(20), program).finished == {0}
    assert measure(run_of(30), program).finished == {0, 1}


@pytest.mark.parametrize(
    ("value", "at_least", "at_most", "verdict"),
    [
        (5.0, None, 5.0, Verdict.PASS),
        (5.1, None, 5.0, Verdict.FAIL),
        (5.0, 5.0, None, Verdict.PASS),
        (4.9, 5.0, None, Verdict.FAIL),
        (5.0, 4.0, 6.0, Verdict.PASS),
        (math.nan, None, 5.0, Verdict.FAIL),
        (math.nan, 5.0, None, Verdict.FAIL),
        (math.nan, None, None, Verdict.FAIL),
        (None, None, 5.0, Verdict.UNSET),
    ],
)
def test_a_value_passes_within_its_limits(
    value: float | None, at_least: float | None, at_most: float | None, verdict: Verdict
) -> None:
    assert judge(value, at_least, at_most) is verdict


def test_a_run_is_as_bad_as_its_worst_criterion() -> None:
    passed, failed, unset = Verdict.PASS, Verdict.FAIL, Verdict.UNSET
    assert overall([passed, unset, failed]) is failed
    assert overall([passed, unset]) is unset
    assert overall([passed, passed]) is passed
    assert overall([]) is unset
