"""The setpoint generator against closed forms."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rtcore.program.generator import GENERATOR, generate, start
from rtcore.program.segments import Segment
from tests.unit.rtcore.programs import HOLD_ROW, PERIOD_S, Row, harmonic, step, table

HOLD_FADE, STOP_FADE = 1000, 2000


def never(_tick: int) -> bool:
    return False


class Walk:
    """A table walked for so many ticks."""

    def __init__(
        self,
        rows: Any,
        ticks: int,
        value: float = 0.0,
        holding: Callable[[int], bool] = never,
        stopping: Callable[[int], bool] = never,
    ) -> None:
        self.g = np.zeros(1, GENERATOR)[0]
        start(self.g, rows, value, PERIOD_S)
        self.value: npt.NDArray[np.float64] = np.empty(ticks)
        self.cycle = np.empty(ticks, int)
        self.stopped = np.empty(ticks, bool)
        for k in range(ticks):
            self.stopped[k] = generate(
                self.g, rows, holding(k), stopping(k), HOLD_FADE, STOP_FADE, PERIOD_S
            )
            self.value[k] = self.g["value"]
            self.cycle[k] = self.g["cycle"]


def test_a_steady_harmonic_is_a_sine_of_its_tick() -> None:
    walk = Walk(table(*harmonic(2000.0, 50.0, 10, mean=500.0)), 1130)
    steady = slice(160, 160 + 800)
    t = (np.arange(1130) - 160)[steady] * PERIOD_S
    expected = 500.0 + 2000.0 * np.sin(2.0 * np.pi * 50.0 * t)
    assert walk.value[steady] == pytest.approx(expected, abs=1e-8)
    assert list(walk.cycle[[160, 239, 240, 959]]) == [0, 0, 1, 9]
    assert walk.cycle[-1] == 10
    assert walk.value[-1] == pytest.approx(500.0)


def test_tapering_cycles_are_not_counted() -> None:
    walk = Walk(table(*harmonic(2000.0, 50.0, 3, taper=5)), 1100)
    assert walk.cycle[:400].max() == 0
    assert walk.cycle.max() == 3


@pytest.mark.parametrize("frequency_hz", [1.0, 77.7, 99.99, 400.0 / 3.0])
def test_phase_does_not_drift_in_a_hundred_million_cycles(frequency_hz: float) -> None:
    ticks = round(1e8 / (frequency_hz * PERIOD_S))
    rows = table(
        {
            "kind": Segment.HARMONIC,
            "ticks": ticks + 1,
            "amplitude_from": 1.0,
            "amplitude_to": 1.0,
            "frequency_from_hz": frequency_hz,
            "frequency_to_hz": frequency_hz,
        }
    )
    walk = Walk(rows, 1)
    walk.g["tick"] = ticks
    generate(walk.g, rows, False, False, HOLD_FADE, STOP_FADE, PERIOD_S)
    turns = Fraction(frequency_hz) * Fraction(PERIOD_S) * ticks
    exact = np.sin(2.0 * np.pi * float(turns - turns.__floor__()))
    assert walk.g["value"] == pytest.approx(exact, abs=2e-7)


def test_a_step_is_the_only_jump() -> None:
    walk = Walk(table(HOLD_ROW | {"ticks": 10}, *step(2000.0, 0.1)), 50, value=100.0)
    assert list(walk.value[8:12]) == [100.0, 100.0, 2000.0, 2000.0]


def test_a_ramp_at_a_rate_takes_as_long_as_it_needs() -> None:
    rows = table({"kind": Segment.LINEAR, "target": -500.0, "rate_per_s": 10e3})
    walk = Walk(rows, 700, value=1000.0)
    assert walk.value[:601] == pytest.approx(1000.0 - 2.5 * np.arange(601))
    assert (walk.value[600:] == -500.0).all()


def test_the_end_leaves_the_setpoint_where_it_is() -> None:
    rows = table(*step(2000.0, 0.01))
    rows["segments"]["target"][2:] = 0.0  # what a bank holds beyond what was written
    walk = Walk(rows, 60)
    assert (walk.value[1:] == 2000.0).all()
    assert walk.g["ended"] == 1


def test_repeats_nest() -> None:
    inner: list[Row] = [
        {"kind": Segment.LINEAR, "target": 1.0, "ticks": 2},
        {"kind": Segment.LINEAR, "target": 0.0, "ticks": 2},
        {"kind": Segment.REPEAT, "jump": 0, "times": 3},
        {"kind": Segment.HOLD, "ticks": 3},
        {"kind": Segment.REPEAT, "jump": 0, "times": 2},
    ]
    walk = Walk(table(*inner), 40)
    once = [0.0, 0.5, 1.0, 0.5] * 3 + [0.0] * 3
    assert list(walk.value) == once * 2 + [0.0] * 10
    assert walk.g["ended"] == 1


def test_a_table_that_takes_no_time_cannot_keep_the_tick() -> None:
    rows = table(
        {"kind": Segment.SMOOTH, "target": 1.0},
        {"kind": Segment.REPEAT, "jump": 0, "times": 1 << 40},
    )
    assert Walk(rows, 3).value[-1] == 1.0


def test_hold_fades_to_the_mean_and_costs_no_cycle() -> None:
    rows = table(*harmonic(2000.0, 50.0, 50, mean=300.0))
    held = Walk(rows, 12000, holding=lambda k: 1000 <= k < 6000)
    assert held.value[1000 + HOLD_FADE : 6000] == pytest.approx(300.0)
    assert (held.cycle[1000 : 6000 + HOLD_FADE] == held.cycle[1000]).all()
    assert held.cycle.max() == 50
    longest = 2.0 * np.pi * 50.0 * 2000.0 * PERIOD_S
    assert np.abs(np.diff(held.value)).max() <= 1.02 * longest


def test_resume_follows_the_same_sine_again_once_it_is_back() -> None:
    rows = table(*harmonic(1.0, 40.0, 400))
    walk = Walk(rows, 9000, holding=lambda k: 1000 <= k < 3333)
    back = np.arange(3333 + HOLD_FADE + 10, 9000)
    turned = 40.0 * PERIOD_S * back
    fitted = np.stack([np.sin(2 * np.pi * turned), np.cos(2 * np.pi * turned)], axis=1)
    _, residual, *_ = np.linalg.lstsq(fitted, walk.value[back], rcond=None)
    assert residual[0] < 1e-12


def test_stop_takes_everything_to_zero_and_says_so() -> None:
    rows = table(*harmonic(2000.0, 50.0, 500, mean=5000.0))
    walk = Walk(rows, 5000, stopping=lambda k: k >= 1000)
    assert not walk.stopped[: 1000 + STOP_FADE - 1].any()
    assert walk.stopped[1000 + STOP_FADE - 1 :].all()
    assert walk.value[1000 + STOP_FADE :] == pytest.approx(0.0, abs=1e-9)
    assert np.abs(np.diff(walk.value)).max() < 1.1 * 2.0 * np.pi * 50.0 * 2000.0 * PERIOD_S + 5.0


def test_layers_keep_phase_through_a_change_of_frequency() -> None:
    common = {"kind": Segment.HARMONIC, "continues": 1, "amplitude_to": 1.0, "ticks": 4000}
    rows = table(
        *({**common, "frequency_to_hz": f} for f in (20.0, 20.0, 80.0, 80.0, 7.0, 7.0)),
    )
    walk = Walk(rows, 24000)
    assert np.abs(np.diff(walk.value)).max() <= 2.0 * np.pi * 80.0 * PERIOD_S * 1.001
    assert np.abs(np.diff(walk.value, 2)).max() <= (2.0 * np.pi * 80.0 * PERIOD_S) ** 2 * 1.02


amplitudes = st.floats(0.0, 50e3)
frequencies = st.floats(0.5, 200.0)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(amplitudes, frequencies, st.floats(-20e3, 20e3)), min_size=1, max_size=4))
def test_harmonics_in_any_order_never_jump(layers: list[tuple[float, float, float]]) -> None:
    rows = [row for a, f, m in layers for row in harmonic(a, f, 2, mean=m, taper=1)]
    ticks = min(sum(row["ticks"] for row in rows) + 5, 60000)
    walk = Walk(table(*rows), ticks)
    steepest = max(
        2.0 * np.pi * f * a + np.pi / 2.0 * f * (a + 40e3) for a, f, _ in layers
    )  # sine, and half a cosine over one period
    assert np.abs(np.diff(walk.value)).max() <= steepest * PERIOD_S * 1.05 + 1e-6
