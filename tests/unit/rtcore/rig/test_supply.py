"""Supply: how pressure comes, goes and is held, from the rig's own record."""

from typing import Any

import numpy as np
import pytest

from rtcore.io import INPUTS, OUTPUTS, SUPPLY_HIGH, SUPPLY_LOW, SUPPLY_OFF
from rtcore.rig.parameters import rig_from
from rtcore.rig.plant import P_1, P_2, P_S, P_T, STATES, U_BLEED, U_PUMP, U_VALVE
from rtcore.rig.world import make_world, read_world, write_world

PERIOD_S = 250e-6


class Bench:
    """A rig on its own, driven by what the loop would ask of it."""

    def __init__(self, **supply: float) -> None:
        self.worlds = make_world(rig_from({"supply": supply}), seed=1)
        self.inputs, self.outputs = np.zeros(1, INPUTS)[0], np.zeros(1, OUTPUTS)[0]

    @property
    def world(self) -> Any:
        return self.worlds[0]

    def run(self, supply: int, duration_s: float) -> np.ndarray:
        """(n, STATES)."""
        self.outputs["supply"] = supply
        found = np.empty((round(duration_s / PERIOD_S), STATES))
        for k in range(len(found)):
            read_world(self.world, self.inputs, PERIOD_S)
            write_world(self.world, self.outputs, PERIOD_S)
            found[k] = self.world["y"]
        return found


def test_a_rig_begins_without_pressure() -> None:
    y = Bench().run(SUPPLY_OFF, 0.5)[-1]
    assert y[[P_S, P_T]] == pytest.approx(0.3e6, rel=1e-3)
    assert np.all(y[[P_1, P_2]] <= 0.3e6)  # the drain draws them a little lower
    assert np.all(y[[P_1, P_2]] > 0.25e6)


def test_pressure_follows_the_pump_up_and_never_falls() -> None:
    supply = Bench().run(SUPPLY_HIGH, 3.0)[:, P_S]
    assert np.all(np.diff(supply) > -1.0)
    pump = np.minimum(0.3e6 + 10e6 * PERIOD_S * np.arange(len(supply)), 21e6)
    assert np.all(supply <= pump + 1.0)
    assert np.all(pump - supply < 0.5e6)  # filling the accumulators costs that much in the line
    assert supply[-1] == pytest.approx(21e6, rel=1e-4)


def test_low_stays_low_until_high_is_asked_for() -> None:
    bench = Bench()
    assert 2.0e6 < bench.run(SUPPLY_LOW, 0.25)[-1, P_S] < 2.9e6  # at the pump's own rate
    assert bench.run(SUPPLY_LOW, 1.5)[-1, P_S] == pytest.approx(7e6, rel=1e-3)
    assert bench.run(SUPPLY_HIGH, 2.0)[-1, P_S] == pytest.approx(21e6, rel=1e-3)
    assert bench.run(SUPPLY_LOW, 0.1)[-1, P_S] > 19e6  # nothing bleeds, so it stays for a while


def test_the_chambers_are_filled_through_the_lands() -> None:
    y = Bench().run(SUPPLY_HIGH, 3.0)[-1]
    assert y[P_1] == pytest.approx(y[P_2], rel=1e-6)
    assert 9e6 < y[P_1] < 11e6


def test_off_bleeds_the_accumulator_within_a_second_and_never_rises() -> None:
    bench = Bench()
    bench.run(SUPPLY_HIGH, 3.0)
    supply = bench.run(SUPPLY_OFF, 1.5)[:, P_S]
    assert np.all(np.diff(supply) < 1.0)
    below_precharge = int(np.argmax(supply < 12e6)) * PERIOD_S
    # 0.35 l leave through a valve that passes 1 l/s at full pressure.
    assert 0.3 < below_precharge < 0.6
    assert supply[round(1.0 / PERIOD_S)] < 0.4e6
    assert bench.world["u"][U_BLEED] == 1.0
    assert bench.world["u"][U_PUMP] == pytest.approx(0.3e6)


def test_a_faster_pump_fills_sooner() -> None:
    ready = [
        int(np.argmax(Bench(ramp_pa_s=ramp).run(SUPPLY_HIGH, 3.0)[:, P_S] > 19e6))
        for ramp in (10e6, 20e6)
    ]
    assert ready[1] == pytest.approx(ready[0] / 2, rel=0.05)


def test_a_command_acts_one_tick_after_it_was_computed() -> None:
    """Computed from the sample of tick 0, held by the converter from tick 1 on, felt in tick 2."""
    bench = Bench()
    bench.run(SUPPLY_HIGH, 0.01)
    held = []
    for command in (0.5, 0.0, 0.0, 0.0):
        bench.outputs["valve_command"] = command
        bench.run(SUPPLY_HIGH, PERIOD_S)
        held.append(float(bench.world["u"][U_VALVE]))
    assert held == [0.0, 0.5, 0.0, 0.0]
