"""The tick's integrator against scipy's Radau, on the commands that the very tick gave."""

from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from bench.recorded import (
    Floats,
    Recording,
    begin,
    make_test,
    quiet_rig,
    ready_rig,
    record,
    true_force,
)
from bench.references import PERIOD_S, radau, solver_states
from bench.report import Figure
from rtcore.rig.constants import plant_constants

TOLERANCE = 1e-10


class Scenario(NamedTuple):
    """A load that begins at rest, and how many ticks of it are compared."""

    name: str
    what: str
    block: dict[str, Any]
    duration_s: float


def _sine(frequency_hz: float) -> dict[str, Any]:
    return {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": frequency_hz, "duration_s": 1}


def _step(to_n: float) -> dict[str, Any]:
    return {"kind": "step", "to_n": to_n, "hold_s": 1}


SCENARIOS = (
    Scenario("step_2_kn", "step of 2 kN", _step(2000), 0.06),
    Scenario("sine_50_hz", "2 kN at 50 Hz", _sine(50), 0.1),
    Scenario("sine_100_hz", "2 kN at 100 Hz", _sine(100), 0.1),
    Scenario("step_30_kn", "step of 30 kN, saturating", _step(30_000), 0.06),
)


class Replayed(NamedTuple):
    """A scenario as the tick had it, and the states after each tick as Radau has them."""

    run: Recording
    truth: Floats


@cache
def replayed(scenario_name: str) -> Replayed:
    """One of `SCENARIOS`, by name; takes Radau some ten seconds."""
    scenario = next(s for s in SCENARIOS if s.name == scenario_name)
    virtual = ready_rig(quiet_rig())
    begin(virtual, make_test([scenario.block]))
    run = record(virtual, round(scenario.duration_s / PERIOD_S))
    plant = plant_constants(quiet_rig())
    return Replayed(run, solver_states(radau, plant, run.before, run.inputs, TOLERANCE))


def force_error(states: Floats, truth: Floats) -> float:
    """Worst error of the force in the load cell, as a share of its peak."""
    force, true = true_force(quiet_rig(), states), true_force(quiet_rig(), truth)
    return float(np.max(np.abs(force - true)) / np.max(np.abs(true)))


def figures() -> Iterator[Figure]:
    """Of all scenarios."""
    for scenario in SCENARIOS:
        found = replayed(scenario.name)
        percent = 100.0 * force_error(found.run.states, found.truth)
        peak = np.max(np.abs(true_force(quiet_rig(), found.truth)))
        yield Figure(
            f"radau_{scenario.name}_percent",
            f"force error against Radau, {scenario.what}",
            percent,
            "%",
            at_most=0.05,
            note=f"{percent:.4f} % of {peak:.0f} N, over {scenario.duration_s * 1e3:.0f} ms",
        )
