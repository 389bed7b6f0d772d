"""The error budget against the virtual rig, which knows the force on its unit."""

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from app.analysis.dynamics import DynamicsReader
from app.analysis.uncertainty import Known, Measured, Source, controlled, measured
from app.analysis.unit_force import REACH, Chain, Inertia
from bench.recorded import begin, make_test, ready_rig
from rtcore.rig.parameters import RigParameters, rig_from
from rtcore.rig.plant import V_2, V_T, X_2, X_T

PERIOD_S = 250e-6
ONLY_WHAT_THE_RIG_HAS = Known(load_cell_n=0.0)  # its load cell has noise and dynamics, but no class
HIGH = {"kind": "harmonic", "amplitude_n": 10_000, "frequency_hz": 100, "duration_s": 2}
LOW = {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 50, "duration_s": 2}
STEP = {"kind": "step", "to_n": 5000, "hold_s": 1}
BLOCKS = {"high": HIGH, "low": LOW, "step": STEP}
MOTION = ({"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "duration_s": 2},)


class Truth:
    """Some of a run on the shipped rig, with the force on its unit, (n,) N, at each tick."""

    def __init__(self, block: dict[str, Any], motion: Any = ()) -> None:
        self.rig = rig_from({})
        virtual = ready_rig(self.rig)
        begin(virtual, make_test([block], motion))
        virtual.keep_states = True
        self.records = virtual.advance(round(1.0 / PERIOD_S))
        states, unit = virtual.states, self.rig.unit
        self.unit_n = unit.k_tra * (states[:, X_2] - states[:, X_T])
        self.unit_n += unit.c_tra * (states[:, V_2] - states[:, V_T])

    def errors_n(self, delay_s: float) -> Any:
        """What the corrected reading is beside the truth of so much earlier."""
        force, velocity = self.records["force_n"], self.records["velocity_m_s"]
        found = force[REACH:-REACH] - Inertia(Chain.of(self.rig), PERIOD_S).take(force, velocity)
        time_s = np.arange(len(self.unit_n)) * PERIOD_S
        return found - CubicSpline(time_s, self.unit_n)(time_s - delay_s)[REACH:-REACH]


@cache
def truth(name: str, moving: bool = False) -> Truth:
    return Truth(BLOCKS[name], MOTION if moving else ())


def budget(run: Truth, known: Known | None = None, cuts: int = 1) -> Measured:
    reader = DynamicsReader(Chain.of(run.rig), PERIOD_S)
    for chunk in np.array_split(run.records, cuts):
        reader.take(chunk)
    return measured(reader.found, run.rig, PERIOD_S, known)


@pytest.mark.parametrize(
    ("name", "moving"), [("high", False), ("low", False), ("low", True), ("step", False)]
)
def test_the_budget_covers_the_true_error_and_little_more(name: str, moving: bool) -> None:
    run = truth(name, moving)
    found = budget(run, ONLY_WHAT_THE_RIG_HAS)
    errors_n = run.errors_n(found.delay_s)
    assert np.mean(np.abs(errors_n) <= found.unit_expanded_n) > 0.93
    assert found.unit_expanded_n < 3 * np.std(errors_n)  # and is not only wide
    assert found.range_n == pytest.approx(np.ptp(run.unit_n), rel=0.02)


def test_the_class_of_the_load_cell_covers_all_of_it() -> None:
    run = truth("low")
    found = budget(run)
    assert found.unit_expanded_n > 2 * 125 / np.sqrt(3)
    assert np.all(np.abs(run.errors_n(found.delay_s)) < found.unit_expanded_n)


def test_without_the_correction_the_inertia_is_the_error() -> None:
    run = truth("high")
    force = run.records["force_n"]
    time_s = np.arange(len(force)) * PERIOD_S
    found = budget(run, ONLY_WHAT_THE_RIG_HAS)
    true = CubicSpline(time_s, run.unit_n)(time_s - found.delay_s)
    uncorrected = np.std(force - true)
    assert found.inertia_rms_n == pytest.approx(uncorrected, rel=0.1)
    assert np.std(run.errors_n(found.delay_s)) < 0.06 * uncorrected


def test_noise_is_measured_from_the_run() -> None:
    parts = {part.name: part for part in budget(truth("low")).contributions}
    noise = parts["Noise of the load cell"]
    assert noise.source is Source.MEASURED
    assert noise.standard_n == pytest.approx(8.0, rel=0.06)  # of the rig's data sheet
    assert parts["Steps of the converter"].standard_n == pytest.approx(
        1.831 / np.sqrt(12), rel=1e-3
    )


def test_jitter_counts_by_the_slope_of_the_force() -> None:
    run = truth("low")
    shaken = run.records.copy()
    random = np.random.default_rng(2)
    shaken["wakeup_latency_s"] = 20e-6 + 5e-6 * random.standard_normal(len(shaken))
    reader = DynamicsReader(Chain.of(run.rig), PERIOD_S)
    reader.take(shaken)
    (part,) = (
        p
        for p in measured(reader.found, run.rig, PERIOD_S).contributions
        if p.name == "Jitter of sampling"
    )
    slope_n_s = np.sqrt(np.mean(np.gradient(run.unit_n, PERIOD_S) ** 2))
    assert part.standard_n == pytest.approx(5e-6 * slope_n_s, rel=0.1)


def test_chunks_and_gaps_change_nothing_that_matters() -> None:
    run = truth("low")
    whole, cut = budget(run), budget(run, cuts=37)
    assert cut.unit_expanded_n == pytest.approx(whole.unit_expanded_n, rel=1e-9)
    assert cut.inertia_rms_n == pytest.approx(whole.inertia_rms_n, rel=1e-9)
    gap = Truth.__new__(Truth)
    gap.rig, gap.records = run.rig, np.delete(run.records, slice(1500, 1520))
    gap.records["force_n"][3000] = np.nan
    assert budget(gap).unit_expanded_n == pytest.approx(whole.unit_expanded_n, rel=0.01)


def test_control_is_told_apart_from_measurement() -> None:
    run = truth("low")
    reader = DynamicsReader(Chain.of(run.rig), PERIOD_S)
    reader.take(run.records)
    found = controlled(reader.found)
    error = run.records["force_command_n"].astype(float) - run.records["force_n"]
    assert found.error_rms_n == pytest.approx(np.sqrt(np.mean(error**2)), rel=1e-6)
    assert found.error_peak_n == pytest.approx(np.max(np.abs(error)), rel=1e-6)
    assert found.unit_error_rms_n > found.error_rms_n  # the inertia comes on top


def test_a_heavier_mass_is_less_certain() -> None:
    heavy = RigParameters.model_validate(rig_from({"structure": {"m_1_kg": 30.0}}).model_dump())
    run = truth("high")
    other = Truth.__new__(Truth)
    other.rig, other.records = heavy, run.records
    assert budget(other).inertia_rms_n > 2 * budget(run).inertia_rms_n
    assert budget(other).unit_expanded_n > budget(run).unit_expanded_n
