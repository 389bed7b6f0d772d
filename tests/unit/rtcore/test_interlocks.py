"""One detector by itself."""

import math
from collections.abc import Iterable
from enum import IntEnum
from typing import Any, cast

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import config

from rtcore import interlocks as detectors_of_loop
from rtcore import modes
from rtcore.interlocks import (
    DETECTOR,
    INTERLOCKS,
    MAX_DETECTORS,
    NO_ACTION,
    TREND,
    Action,
    Comparison,
    Form,
    Quantity,
    SensorFault,
    armed_in,
    check_detector,
    interlocks_are_valid,
    is_violated,
    judged_value,
    latches,
)
from rtcore.modes import Mode
from tests.unit.rtcore.programs import FORCE_LIMIT, detector, interlocks, record_of

finite = st.floats(allow_nan=False, allow_infinity=False, width=32)


def one(comparison: Comparison, threshold: float) -> Any:
    record = record_of(DETECTOR)
    record["comparison"] = comparison
    record["threshold"] = threshold
    record["enabled"] = 1
    record["armed_modes"] = 1 << Mode.RUNNING
    return record


@given(value=finite, threshold=finite)
def test_comparisons_mean_what_they_say(value: float, threshold: float) -> None:
    assert is_violated(one(Comparison.ABOVE, threshold), value) == (value > threshold)
    assert is_violated(one(Comparison.BELOW, threshold), value) == (value < threshold)
    above = is_violated(one(Comparison.MAGNITUDE_ABOVE, threshold), value)
    assert above == (abs(value) > threshold)


@pytest.mark.parametrize("comparison", Comparison)
def test_a_nan_is_a_violation_on_either_side(comparison: Comparison) -> None:
    assert is_violated(one(comparison, 1.0), math.nan)
    assert is_violated(one(comparison, math.nan), 0.0)


def test_infinity_is_a_violation() -> None:
    assert is_violated(one(Comparison.MAGNITUDE_ABOVE, 1e9), -math.inf)


def test_a_detector_counts_only_where_it_is_armed_and_enabled() -> None:
    record = one(Comparison.ABOVE, 1.0)
    assert check_detector(record, 2.0, Mode.RUNNING, 4) == 5
    assert check_detector(record, 2.0, Mode.RUNNING, 5) == 6
    assert check_detector(record, 2.0, Mode.READY, 4) == 0
    assert check_detector(record, 0.5, Mode.RUNNING, 4) == 0
    record["enabled"] = 0
    assert check_detector(record, 2.0, Mode.RUNNING, 4) == 0


@pytest.mark.parametrize(
    "wrong",
    [
        {"quantity": len(Quantity)},
        {"quantity": -1},
        {"quantity": len(Quantity) + 1},
        {"quantity": -2},
        {"form": len(Form)},
        {"form": -1},
        {"form": len(Form) + 1},
        {"form": -2},
        {"horizon_s": -1.0},
        {"horizon_s": math.inf},
        {"horizon_s": math.nan},
        {"smoothing_s": math.nan},
        {"smoothing_s": math.inf},
        {"smoothing_s": -1.0},
        {"comparison": Comparison.OUTSIDE, "low": 55e3},
        {"comparison": Comparison.OUTSIDE, "low": -math.inf},
        {"comparison": Comparison.OUTSIDE, "low": 56e3},
        {"comparison": Comparison.OUTSIDE, "low": math.nan},
        {"comparison": len(Comparison)},
        {"comparison": len(Comparison) + 1},
        {"comparison": -1},
        {"comparison": -2},
        {"action": len(Action)},
        {"action": len(Action) + 1},
        {"action": -1},
        {"action": -2},
        {"persistence_ticks": 0},
        {"persistence_ticks": -1},
        {"threshold": math.nan},
        {"threshold": math.inf},
    ],
)
def test_the_loop_refuses_a_meaningless_detector(wrong: dict[str, float]) -> None:
    assert interlocks_are_valid(interlocks(FORCE_LIMIT))
    assert not interlocks_are_valid(interlocks(FORCE_LIMIT, {**FORCE_LIMIT, **wrong}))


def test_a_full_table_is_taken_and_one_more_is_not() -> None:
    record = interlocks(*[FORCE_LIMIT] * MAX_DETECTORS)
    assert interlocks_are_valid(record)
    record["count"] = MAX_DETECTORS + 1
    assert not interlocks_are_valid(record)
    record["count"] = MAX_DETECTORS
    record["detectors"][MAX_DETECTORS - 1]["persistence_ticks"] = 0
    assert not interlocks_are_valid(record)


def test_a_detector_may_be_all_that_its_fields_can_say() -> None:
    """Every member of every enumeration, and the ends of what is bounded."""
    for name, members in (
        ("quantity", Quantity),
        ("form", Form),
        ("comparison", Comparison),
        ("action", Action),
    ):
        assert sorted(members) == list(range(len(members)))
        for member in members:
            assert interlocks_are_valid(interlocks({**FORCE_LIMIT, name: member, "low": -55e3}))
    for ticks, seconds in ((1, 0.0), (2, 0.5), (240_000, 60.0)):
        times = {"persistence_ticks": ticks, "horizon_s": seconds, "smoothing_s": seconds}
        assert interlocks_are_valid(interlocks({**FORCE_LIMIT, **times}))
    assert interlocks_are_valid(interlocks({**FORCE_LIMIT, "low": 56e3}))  # no band: not looked at


@pytest.mark.parametrize(
    ("members", "names"),
    [
        (Form, "VALUE RATE LOOK_AHEAD"),
        (Comparison, "MAGNITUDE_ABOVE ABOVE BELOW OUTSIDE"),
        (Action, "INDICATE HOLD STOP SHUTDOWN"),
        (
            SensorFault,
            "NONE NOT_A_NUMBER SATURATED FROZEN NOISE_FREE OUT_OF_RANGE IMPLAUSIBLE",
        ),
        (
            Quantity,
            "FORCE_N FORCE_ERROR_N DISPLACEMENT_M VELOCITY_M_S SUPPLY_PRESSURE_PA LOAD_CELL APP_SILENCE_S"
            " DEADLINES_MISSED LVT LVDT PRESSURE_SENSOR FORCE_ERROR_RELATIVE UNDERPEAK VALVE_COMMAND"
            " VALVE_SATURATION CYCLES TWIN_RESIDUAL_N TWIN_GOODNESS UNRECORDED_S CHAIN_OPEN"
            " DISPLACEMENT_ERROR_M PRESSURE_1_PA PRESSURE_2_PA TWIN_SPOOL",
        ),
    ],
)
def test_what_crosses_the_memory_is_numbered_as_recordings_have_it(
    members: type[IntEnum], names: str
) -> None:
    assert {member.name: int(member) for member in members} == {
        name: number for number, name in enumerate(names.split())
    }
    assert NO_ACTION == -1 < min(Action)
    assert MAX_DETECTORS == 64  # the bits of the trips


@given(low=finite, high=finite, value=finite)
def test_a_band_is_violated_on_either_side(low: float, high: float, value: float) -> None:
    record = one(Comparison.OUTSIDE, high)
    record["low"] = low
    assert is_violated(record, value) == (value < low or value > high)


def judged(form: Form, values: Iterable[float], **other: float) -> list[float]:
    """What a detector of this form compares, tick by tick."""
    record = one(Comparison.ABOVE, 0.0)
    record["form"] = form
    for name, value in other.items():
        record[name] = value
    trend = record_of(TREND)
    trend["last"] = math.nan
    return [judged_value(record, trend, value, 250e-6) for value in values]


@given(start=finite, slope=st.floats(-1e6, 1e6))
def test_a_value_is_compared_as_it_is(start: float, slope: float) -> None:
    ramp = [start + slope * k for k in range(5)]
    assert judged(Form.VALUE, ramp, horizon_s=1.0) == ramp


def test_a_form_that_nobody_knows_is_the_value() -> None:
    ramp = [0.0, 1.0, 2.0]
    for unknown in (-1, len(Form)):
        assert judged(cast(Form, unknown), ramp, horizon_s=1.0) == ramp


@pytest.mark.parametrize("unknown", [-1, len(Comparison)])
def test_a_comparison_that_nobody_knows_is_a_violation(unknown: int) -> None:
    record = one(Comparison.OUTSIDE, 10.0)
    record["low"], record["comparison"] = -10.0, unknown
    assert is_violated(record, 0.0)


def test_a_magnitude_has_no_lower_end() -> None:
    record = one(Comparison.MAGNITUDE_ABOVE, 10.0)
    record["low"] = 5.0
    assert not is_violated(record, -7.0)
    assert not is_violated(record, 3.0)


def test_records_of_the_shared_block_are_laid_out_as_in_c() -> None:
    for dtype in (DETECTOR, INTERLOCKS, TREND):
        assert dtype.isalignedstruct


@given(slope=st.floats(-1e7, 1e7))
def test_a_rate_is_the_change_in_a_second(slope: float) -> None:
    rates = judged(Form.RATE, [slope * k * 250e-6 for k in range(4)])
    assert rates[0] == 0.0  # nothing is known before the second value
    assert rates[1:] == pytest.approx([slope] * 3, rel=1e-9, abs=1e-9)


def test_a_rate_is_smoothed_over_its_time() -> None:
    ramp = [1000.0 * k * 250e-6 for k in range(401)]
    rates = judged(Form.RATE, ramp, smoothing_s=25e-3)
    assert rates[100] == pytest.approx(1000.0 * (1.0 - (1.0 - 0.01) ** 100), rel=1e-9)
    assert judged(Form.RATE, ramp, smoothing_s=1e-6)[1] == pytest.approx(1000.0)


@given(slope=st.floats(-1e7, 1e7), horizon_s=st.floats(0.0, 1.0))
def test_a_look_ahead_goes_on_along_the_ramp(slope: float, horizon_s: float) -> None:
    ramp = [5.0 + slope * k * 250e-6 for k in range(4)]
    ahead = judged(Form.LOOK_AHEAD, ramp, horizon_s=horizon_s)
    expected = 5.0 + slope * (3 * 250e-6 + horizon_s)
    assert ahead[3] == pytest.approx(expected, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("broken", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_is_judged_as_such_and_leaves_nothing_behind(
    form: Form, broken: float
) -> None:
    values = judged(form, [1.0, broken, 1.0, 1.0], horizon_s=0.1)
    assert values[1] == broken or math.isnan(values[1])
    assert values[2:] == ([0.0, 0.0] if form == Form.RATE else [1.0, 1.0])


@pytest.mark.parametrize("latching", [0, 1])
@pytest.mark.parametrize("action", Action)
def test_what_takes_the_load_off_always_latches(action: Action, latching: int) -> None:
    record = one(Comparison.ABOVE, 1.0)
    record["action"], record["latching"] = action, latching
    assert latches(record) == (latching == 1 or action in (Action.STOP, Action.SHUTDOWN))


@given(modes=st.sets(st.sampled_from(Mode)))
def test_a_detector_is_armed_in_the_modes_that_were_named(modes: set[Mode]) -> None:
    record = one(Comparison.ABOVE, 1.0)
    record["armed_modes"] = armed_in(*modes)
    for mode in Mode:
        assert check_detector(record, 2.0, mode, 0) == (1 if mode in modes else 0)


def test_an_empty_table_is_refused() -> None:
    record = interlocks(detector(Quantity.FORCE_N, 1.0, Action.STOP))
    record["count"] = 0
    assert not interlocks_are_valid(record)


@pytest.mark.skipif(config.DISABLE_JIT, reason="nothing is compiled here")
@pytest.mark.parametrize(
    "kernel",
    [
        *(judged_value, is_violated, check_detector, latches, interlocks_are_valid),
        *(detectors_of_loop.detector_is_valid, modes.next_mode, modes.is_pressurised),
        *(modes.is_closed_loop, modes.is_run),
    ],
)
def test_every_kernel_is_compiled(kernel: object) -> None:
    assert hasattr(kernel, "py_func")
