"""Overshoot, rise and settling against the closed forms of first- and second-order lags."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from scipy.optimize import brentq

from app.analysis.step_response import StepFollower, StepResponse, step_response

PERIOD_S = 1e-5
TIME_S = np.arange(200_000) * PERIOD_S


def _second_order(zeta: float, omega: float, time_s: npt.ArrayLike) -> npt.NDArray[np.float64]:
    root = math.sqrt(1 - zeta**2)
    angle = omega * root * np.asarray(time_s) + math.acos(zeta)
    return 1 - np.exp(-zeta * omega * np.asarray(time_s)) * np.sin(angle) / root


@pytest.mark.parametrize("zeta", [0.2, 0.4, 0.7])
@pytest.mark.parametrize(("begin", "end"), [(0.0, 2000.0), (5000.0, -1000.0)])
def test_a_second_order_lag(zeta: float, begin: float, end: float) -> None:
    omega = 50.0
    found = step_response(
        begin + (end - begin) * _second_order(zeta, omega, TIME_S), begin, end, PERIOD_S
    )
    overshoot = 100 * math.exp(-math.pi * zeta / math.sqrt(1 - zeta**2))
    assert found.overshoot_percent == pytest.approx(overshoot, rel=1e-4)
    peak_s = math.pi / (omega * math.sqrt(1 - zeta**2))
    at = [
        brentq(lambda t, level=level: float(_second_order(zeta, omega, t)) - level, 0, peak_s)
        for level in (0.1, 0.9)
    ]
    assert found.rise_s == pytest.approx(at[1] - at[0], rel=1e-4)
    outside = np.abs(_second_order(zeta, omega, TIME_S) - 1) > 0.02
    settled_s = TIME_S[np.flatnonzero(outside)[-1]]
    envelope_s = -math.log(0.02 * math.sqrt(1 - zeta**2)) / (zeta * omega)
    assert found.settling_s == pytest.approx(settled_s, abs=2 * PERIOD_S)
    assert found.settling_s <= envelope_s


def test_a_first_order_lag_rises_in_ln_9_and_settles_in_ln_50_time_constants() -> None:
    tau_s = 0.05
    found = step_response(1 - np.exp(-TIME_S / tau_s), 0, 1, PERIOD_S)
    assert found.overshoot_percent == 0
    assert found.rise_s == pytest.approx(math.log(9) * tau_s, rel=1e-4)
    assert found.settling_s == pytest.approx(math.log(50) * tau_s, rel=1e-3)


def test_a_response_that_never_gets_there_has_neither_rise_nor_settling() -> None:
    found = step_response(np.full(100, 0.5), 0, 1, PERIOD_S)
    assert math.isnan(found.rise_s)
    assert math.isnan(found.settling_s)


def test_a_response_that_ends_outside_the_band_has_not_settled() -> None:
    ringing = 1 + 0.05 * np.sin(TIME_S * 2000)
    assert math.isnan(step_response(ringing[: 1000 + 78], 0, 1, PERIOD_S).settling_s)


def test_a_sample_that_is_not_a_number_is_not_settled() -> None:
    response = np.ones(100)
    response[40] = np.nan
    assert step_response(response, 0, 1, 1.0).settling_s == 41


def _seen(samples: npt.NDArray[np.int64], response: npt.NDArray[np.float64]) -> StepResponse:
    follower = StepFollower(0.0, 1.0, 1.0, 2000)
    follower.take(samples, response[samples])
    return follower.read()


LAG = 1 - np.exp(-np.arange(4000) / 40.0)  # 5 % at 2.1, 10 % at 4.2, 90 % at 92.1, 98 % at 156.5


@pytest.mark.parametrize(
    ("first", "last", "dead", "rise", "settling"),
    [
        (0, 0, 2.05, 87.9, 157),
        (4, 20, 2.05, math.nan, 157),  # 10 % was reached while nobody looked
        (2, 400, math.nan, math.nan, 400),  # all of it; from 400 on it is seen to be settled
        (100, 300, 2.05, 87.9, 300),
        (20, 80, 2.05, 87.9, 157),  # between the two
        (0, 50, math.nan, math.nan, 157),
        (0, 2, 2.05, 87.9, 157),
    ],
)
def test_what_happened_while_ticks_were_missed_is_not_made_up(
    first: int, last: int, dead: float, rise: float, settling: float
) -> None:
    wanted = pytest.approx((dead, rise, settling), abs=0.02, nan_ok=True)
    kept = np.delete(np.arange(4000), slice(first, last))
    found = _seen(kept, LAG)
    assert (found.dead_time_s, found.rise_s, found.settling_s) == wanted
    gaps = LAG.copy()
    gaps[first:last] = np.nan
    found = _seen(np.arange(4000), gaps)
    assert (found.dead_time_s, found.rise_s, found.settling_s) == wanted


def test_a_step_without_height_or_samples_is_no_step() -> None:
    for response, end in ((np.ones(3), 0.0), (np.ones(0), 1.0)):
        with pytest.raises(ValueError, match="height"):
            step_response(response, 0.0, end, PERIOD_S)
