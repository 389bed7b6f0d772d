"""Measurements of made-up runs, whose values are known beforehand."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from app.analysis.acceptance import Verdict, judge, overall
from app.analysis.evidence import StepWindow, Windows, gather
from app.analysis.measurements import MEASUREMENTS, measure_all
from rtcore.channels import TELEMETRY
from rtcore.modes import Mode

PERIOD_S = 250e-6


def _run(ticks: int, **channels: npt.ArrayLike) -> npt.NDArray[Any]:
    records = np.zeros(ticks, TELEMETRY)
    records["tick"] = 5000 + np.arange(ticks)
    records["mode"] = Mode.RUNNING
    for name, values in channels.items():
        records[name] = values
    return records


def _measure(records: npt.NDArray[Any], found: Windows, **others: Any) -> dict[str, float | None]:
    return measure_all(gather(records, found, PERIOD_S, **others))


def test_errors_are_taken_over_counted_cycles_only() -> None:
    error_n = np.full(1000, 900.0)  # while it tapers
    error_n[200:500] = 30.0
    error_n[600:700] = -40.0
    found = Windows(1000, cycles=((200, 500), (600, 700)))
    values = _measure(_run(1000, force_error_n=error_n), found)
    expected = math.sqrt((300 * 30**2 + 100 * 40**2) / 400)
    assert values["force_error_rms_n"] == pytest.approx(expected)
    assert values["force_error_peak_n"] == 40


def test_errors_of_a_test_without_cycles_are_taken_over_all_of_it() -> None:
    values = _measure(_run(4, force_error_n=[3, -4, 0, 0]), Windows(4))
    assert values["force_error_rms_n"] == 2.5
    assert values["force_error_peak_n"] == 4


def test_peaks_and_saturation_are_taken_over_the_whole_run() -> None:
    run = _run(
        4,
        force_n=[100, -900, 3, 0],
        displacement_m=[0.001, -0.002, 0, 0],
        valve_command=[0.5, -0.5, 0.49, 0],
    )
    found = Windows(4, cycles=((2, 4),))
    values = _measure(run, found, valve_limit=0.5)
    assert values["peak_force_n"] == 900
    assert values["peak_displacement_m"] == pytest.approx(0.002)
    assert values["valve_saturation_share"] == 0.5
    assert _measure(run, found)["valve_saturation_share"] == 0


def test_the_fade_after_the_program_is_not_measured() -> None:
    run = _run(10, force_n=[1] * 6 + [99] * 4)
    run["mode"][8:] = Mode.STOPPING
    assert _measure(run, Windows(6))["peak_force_n"] == 1


def test_what_follows_a_trip_is_not_measured() -> None:
    run = _run(10, force_n=[1] * 6 + [99] * 4)
    run["mode"][6:] = Mode.TRIPPED
    assert _measure(run, Windows(1000))["peak_force_n"] == 1


def test_goodness_needs_a_reference_and_compares_the_counted_cycles() -> None:
    run = _run(1000, force_n=np.where(np.arange(1000) < 500, 2000, 5000))
    reference = _run(900, force_n=1900)
    found = Windows(1000, cycles=((100, 400),))
    assert _measure(run, found)["goodness_of_fit"] is None
    values = _measure(run, found, reference=reference)
    assert values["goodness_of_fit"] == pytest.approx(95)


def test_the_worst_of_all_steps_is_measured() -> None:
    force_n = np.zeros(300)
    force_n[10:100] = 1100  # overshoot 10 %
    force_n[100:110] = 1000
    force_n[110:200] = -600  # 0 to -500: overshoot 20 %
    force_n[200:] = 0
    steps = (StepWindow(0, 110, 0, 1000), StepWindow(110, 200, 0, -500))
    values = _measure(_run(300, force_n=force_n), Windows(300, steps=steps))
    assert values["step_overshoot_percent"] == pytest.approx(20)
    assert values["step_settling_s"] is not None
    assert math.isnan(values["step_settling_s"])  # the second never settles


def test_without_a_step_there_is_nothing_to_measure_of_one() -> None:
    values = _measure(_run(10), Windows(10))
    assert values["step_overshoot_percent"] is None
    assert set(values) == set(MEASUREMENTS)
    assert set(_measure(_run(0), Windows(10)).values()) == {None}


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


def test_a_run_that_ends_before_its_first_cycle_has_a_peak_but_no_error() -> None:
    run = _run(100, force_n=np.full(100, -70.0), force_error_n=np.full(100, 900.0))
    values = _measure(run, Windows(1000, cycles=((200, 500),)))
    assert values["peak_force_n"] == 70
    assert values["force_error_rms_n"] is None
    assert values["force_error_peak_n"] is None
