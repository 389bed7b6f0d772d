"""One detector by itself."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.interlocks import (
    DETECTOR,
    Action,
    Comparison,
    Form,
    Quantity,
    check_detector,
    interlocks_are_valid,
    is_violated,
)
from rtcore.modes import Mode
from tests.unit.rtcore.programs import FORCE_LIMIT, detector, interlocks

finite = st.floats(allow_nan=False, allow_infinity=False, width=32)


def one(comparison: Comparison, threshold: float) -> Any:
    record = np.zeros(1, DETECTOR)[0]
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
    assert check_detector(record, 2.0, Mode.READY, 4) == 0
    assert check_detector(record, 0.5, Mode.RUNNING, 4) == 0
    record["enabled"] = 0
    assert check_detector(record, 2.0, Mode.RUNNING, 4) == 0


@pytest.mark.parametrize(
    "wrong",
    [
        {"quantity": len(Quantity)},
        {"quantity": -1},
        {"form": len(Form)},
        {"form": -1},
        {"horizon_s": -1.0},
        {"horizon_s": math.inf},
        {"smoothing_s": math.nan},
        {"comparison": Comparison.OUTSIDE, "low": 56e3},
        {"comparison": Comparison.OUTSIDE, "low": math.nan},
        {"comparison": len(Comparison)},
        {"action": len(Action)},
        {"persistence_ticks": 0},
        {"threshold": math.nan},
        {"threshold": math.inf},
    ],
)
def test_the_loop_refuses_a_meaningless_detector(wrong: dict[str, float]) -> None:
    assert interlocks_are_valid(interlocks(FORCE_LIMIT))
    assert not interlocks_are_valid(interlocks(FORCE_LIMIT, {**FORCE_LIMIT, **wrong}))


def test_an_empty_table_is_refused() -> None:
    record = interlocks(detector(Quantity.FORCE_N, 1.0, Action.STOP))
    record["count"] = 0
    assert not interlocks_are_valid(record)
