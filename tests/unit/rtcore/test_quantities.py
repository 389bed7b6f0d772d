"""What detectors watch, against closed forms."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest

from app.analysis.goodness import goodness_of_fit
from rtcore.core import CORE, make_core
from rtcore.interlocks import Quantity
from rtcore.quantities import observe

PERIOD_S = 250e-6


class Watched:
    """A core whose setpoint, force and valve are told, tick after tick."""

    def __init__(self) -> None:
        self.cores = np.asarray(make_core(PERIOD_S, {}), CORE)
        self.core = self.cores[0]
        self.core["inputs"]["chain"] = 1

    def see(self, command_n: float, force_n: float, *, valve: float = 0.0, cycle: int = 0) -> Any:
        self.core["force"]["value"], self.core["force"]["cycle"] = command_n, cycle
        self.core["sample"]["force_n"] = force_n
        self.core["outputs"]["valve_command"] = valve
        observe(self.core, 1.0, 0.0, 0, 0.0)
        return self.core["observed"]["quantities"]

    def harmonic(self, gain: float, cycles: int, lag: float = 0.0) -> Any:
        """So many cycles of 2 kN at 50 Hz, the force `gain` times that, `lag` of a cycle later."""
        self.core["force"]["frequency_hz"] = 50.0
        self.core["run"] = 7
        for k in range(cycles * 80 + 1):
            angle = 2 * np.pi * k / 80
            force_n = gain * 2e3 * np.sin(angle - 2 * np.pi * lag)
            seen = self.see(2e3 * np.sin(angle), force_n, cycle=k // 80)
        return seen


@pytest.mark.parametrize(("gain", "lag"), [(1.0, 0.0), (0.8, 0.0), (0.8, 0.25), (1.4, 0.1)])
def test_underpeak_is_the_share_by_which_the_swing_falls_short(gain: float, lag: float) -> None:
    seen = Watched().harmonic(gain, 3, lag)
    assert seen[Quantity.UNDERPEAK] == pytest.approx(1.0 - gain, abs=1e-3)


def test_underpeak_is_none_where_no_harmonic_plays() -> None:
    watched = Watched()
    assert watched.harmonic(0.5, 2)[Quantity.UNDERPEAK] == pytest.approx(0.5, abs=1e-3)
    watched.core["force"]["frequency_hz"] = 0.0
    assert watched.see(100.0, 0.0)[Quantity.UNDERPEAK] == 0.0


def test_cycles_are_those_of_the_run_over_all_its_blocks() -> None:
    watched = Watched()
    assert watched.harmonic(1.0, 5)[Quantity.CYCLES] == 5
    watched.core["force"]["block"] = 1  # counts its own from 0
    assert watched.see(0.0, 0.0)[Quantity.CYCLES] == 5
    assert watched.harmonic(1.0, 3)[Quantity.CYCLES] == 8
    watched.core["run"] = 0
    assert watched.see(0.0, 0.0)[Quantity.CYCLES] == 0


def test_the_relative_error_is_that_of_the_recent_peak() -> None:
    watched = Watched()
    watched.see(20e3, 20e3)
    assert watched.see(0.0, 2e3)[Quantity.FORCE_ERROR_RELATIVE] == pytest.approx(0.1, rel=1e-3)
    for _ in range(20_000):
        seen = watched.see(0.0, 100.0)
    assert seen[Quantity.FORCE_ERROR_RELATIVE] == pytest.approx(0.1, rel=1e-3)  # of 1 kN at least


def test_saturation_is_a_share_of_the_last_time() -> None:
    watched = Watched()
    for k in range(8000):
        seen = watched.see(0.0, 0.0, valve=1.0 if k % 4 == 0 else 0.0)
    assert seen[Quantity.VALVE_SATURATION] == pytest.approx(0.25, abs=2e-3)
    for _ in range(1000):
        seen = watched.see(0.0, 0.0, valve=-0.99)
    assert seen[Quantity.VALVE_SATURATION] == pytest.approx(1.0 - 0.75 * np.exp(-1.0), abs=2e-3)
    assert seen[Quantity.VALVE_COMMAND] == -0.99


def test_a_valve_command_that_is_no_number_counts_as_saturated() -> None:
    watched = Watched()
    watched.see(0.0, 0.0, valve=float("nan"))
    assert watched.core["observed"]["saturated"] > 0.0


def beside_its_twin(watched: Watched, forces: Iterable[tuple[float, float]]) -> Any:
    watched.core["observed"]["has_twin"] = 1
    for force_n, twin_n in forces:
        watched.core["observed"]["twin_force_n"] = twin_n
        seen = watched.see(0.0, force_n)
    return seen


def test_rolling_goodness_is_that_of_the_paper_where_nothing_changes() -> None:
    angles = 2 * np.pi * np.arange(40_000) / 80
    force_n = 2e3 * np.sin(angles)
    twin_n = 1.8e3 * np.sin(angles - 0.2)
    seen = beside_its_twin(Watched(), zip(force_n, twin_n, strict=True))
    assert seen[Quantity.TWIN_RESIDUAL_N] == pytest.approx(force_n[-1] - twin_n[-1])
    expected = goodness_of_fit(force_n[-8000:], twin_n[-8000:])
    assert seen[Quantity.TWIN_GOODNESS] == pytest.approx(expected, abs=0.1)


def test_a_twin_that_was_no_number_is_told_and_forgotten() -> None:
    watched = Watched()
    seen = beside_its_twin(watched, [(0.0, float("nan"))])
    assert np.isnan(seen[Quantity.TWIN_RESIDUAL_N])
    assert np.isnan(seen[Quantity.TWIN_GOODNESS])
    seen = beside_its_twin(watched, [(0.0, 0.0)] * 4)
    assert seen[Quantity.TWIN_GOODNESS] == 100.0


def test_without_a_twin_there_is_nothing_to_differ_from() -> None:
    watched = Watched()
    seen = watched.see(0.0, 5e3)
    assert seen[Quantity.TWIN_RESIDUAL_N] == 0.0
    assert seen[Quantity.TWIN_GOODNESS] == 100.0


def test_an_open_chain_is_one_that_does_not_say_closed() -> None:
    watched = Watched()
    assert watched.see(0.0, 0.0)[Quantity.CHAIN_OPEN] == 0.0
    for word in (0, 2, -1):
        watched.core["inputs"]["chain"] = word
        assert watched.see(0.0, 0.0)[Quantity.CHAIN_OPEN] == 1.0


def test_residuals_are_what_was_measured_less_what_the_twin_has() -> None:
    watched = Watched()
    watched.core["inputs"]["spool_position"] = 0.25
    watched.core["observed"]["twin_spool"] = 0.40
    seen = beside_its_twin(watched, [(1500.0, 1200.0)])
    assert seen[Quantity.TWIN_SPOOL] == pytest.approx(-0.15)
    assert seen[Quantity.TWIN_RESIDUAL_N] == pytest.approx(300.0)
    watched.core["observed"]["has_twin"] = 0
    seen = watched.see(0.0, 1500.0)
    assert (seen[Quantity.TWIN_SPOOL], seen[Quantity.TWIN_RESIDUAL_N]) == (0.0, 0.0)
