"""Sweeps and samples of the setpoint generator against scipy."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator
from scipy.signal import chirp

from rtcore.program.segments import KNOT, Segment
from tests.unit.rtcore.programs import PERIOD_S, Row, table
from tests.unit.rtcore.test_generator import HOLD_FADE, Walk


def sweep(begin_hz: float, end_hz: float, ticks: int, **other: Any) -> Row:
    return {
        "kind": Segment.SWEEP,
        "ticks": ticks,
        "amplitude_from": 1.0,
        "amplitude_to": 1.0,
        "frequency_from_hz": begin_hz,
        "frequency_to_hz": end_hz,
        "mean_from": 0.0,
        "counts": 1,
        **other,
    }


@pytest.mark.parametrize(("begin_hz", "end_hz"), [(1.0, 100.0), (100.0, 1.0), (30.0, 30.0)])
def test_a_sweep_is_a_logarithmic_chirp(begin_hz: float, end_hz: float) -> None:
    ticks = 8000
    walk = Walk(table(sweep(begin_hz, end_hz, ticks)), ticks)
    t = np.arange(ticks) * PERIOD_S
    expected = chirp(t, begin_hz, ticks * PERIOD_S, end_hz, method="logarithmic", phi=-90)
    assert walk.value == pytest.approx(expected, abs=1e-9)


def test_a_sweep_counts_its_cycles_and_hands_its_phase_on() -> None:
    rows = table(
        sweep(10.0, 40.0, 8000),
        {
            "kind": Segment.HARMONIC,
            "continues": 1,
            "ticks": 400,
            "amplitude_to": 1.0,
            "frequency_to_hz": 40.0,
            "counts": 1,
        },
    )
    walk = Walk(rows, 8400)
    turned = 30.0 / np.log(4.0) * 2.0  # (f1 - f0) / ln(f1 / f0) · T
    assert walk.cycle[7999] == int(turned)
    assert walk.g["frequency_hz"] == pytest.approx(40.0)
    assert np.abs(np.diff(walk.value)).max() <= 2 * np.pi * 40.0 * PERIOD_S * 1.001
    assert np.abs(np.diff(walk.value, 2)).max() <= (2 * np.pi * 40.0 * PERIOD_S) ** 2 * 1.01


def knots_of(values: Any, slopes: Any) -> npt.NDArray[Any]:
    knots = np.empty(len(values), KNOT)
    knots["value"], knots["slope"] = values, slopes
    return knots


def samples(knots: npt.NDArray[Any], rate_hz: float, mean: float = np.nan) -> Any:
    """A table that plays knots, from a setpoint that is the first of them."""
    ticks = int(np.ceil((len(knots) - 1) / (rate_hz * PERIOD_S) - 1e-9))
    row = {"kind": Segment.SAMPLES, "ticks": ticks, "times": len(knots), "rate_per_s": rate_hz}
    record = table(row | {"mean_to": mean})
    record["knots"][: len(knots)] = knots
    record["knot_count"] = len(knots)
    return record


@pytest.mark.parametrize("rate_hz", [100.0, 333.3, 1024.0, 4000.0])
def test_samples_are_a_hermite_spline_through_their_knots(rate_hz: float) -> None:
    rng = np.random.default_rng(3)
    values, slopes = rng.normal(size=200), rng.normal(size=200)
    rows = samples(knots_of(values, slopes), rate_hz)
    ticks = int(rows["segments"][0]["ticks"])
    walk = Walk(rows, ticks + 3, value=values[0])
    u = np.arange(ticks) * PERIOD_S * rate_hz
    assert walk.value[:ticks] == pytest.approx(
        CubicHermiteSpline(np.arange(200), values, slopes)(np.minimum(u, 199)), abs=1e-6
    )
    assert (walk.value[ticks:] == values[-1]).all()
    assert walk.g["ended"] == 1
    assert walk.g["starved"] == 0


def test_monotone_slopes_never_overshoot() -> None:
    values = np.array([0.0, 0.0, 1.0, 1.0, -3.0, -3.0, 0.0])
    slopes = PchipInterpolator(np.arange(7), values).derivative()(np.arange(7))
    walk = Walk(samples(knots_of(values, slopes), 37.0), 600)
    assert walk.value.max() == pytest.approx(1.0, abs=1e-15)
    assert walk.value.min() == pytest.approx(-3.0, abs=1e-15)


def test_held_samples_stay_or_fade_to_their_mean_and_go_on_where_they_were() -> None:
    values = np.sin(np.arange(400) / 5.0)
    knots = knots_of(values, np.cos(np.arange(400) / 5.0) / 5.0)
    held = range(300, 3000)
    still = Walk(samples(knots, 400.0), 7000, holding=lambda k: k in held)
    assert np.ptp(still.value[300:3000]) == 0.0
    faded = Walk(samples(knots, 400.0, mean=0.2), 7000, holding=lambda k: k in held)
    assert faded.value[300 + HOLD_FADE : 3000] == pytest.approx(0.2)
    free = Walk(samples(knots, 400.0), 7000)
    back = 3000 + HOLD_FADE  # frozen until the fade is done
    lost = back - 301
    assert faded.value[back:6000] == pytest.approx(free.value[back - lost : 6000 - lost], abs=0.01)


def test_knots_that_do_not_come_leave_the_setpoint_where_it_is() -> None:
    knots = knots_of(np.linspace(0.0, 1.0, 50), np.full(50, 1 / 49))
    rows = samples(knots, 4000.0)
    rows["knot_count"] = 20
    walk = Walk(rows, 100)
    assert walk.g["starved"] == 1
    assert walk.g["ended"] == 0
    assert (walk.value[20:] == walk.value[18]).all()
