"""Which sensors can be believed: each fault by itself, and what must not be taken for one."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest

from rtcore.core import CORE, make_core
from rtcore.interlocks import SensorFault
from rtcore.sample import sensors_are_sound, take_sample

PERIOD_S = 250e-6
NOISE = {"force_noise_n": 15.6, "velocity_noise_m_s": 0.4e-3}
RNG = np.random.default_rng(11)
Inputs = dict[str, float]


class Converters:
    """A core that is fed what its converters deliver."""

    def __init__(self) -> None:
        self.cores = np.asarray(make_core(PERIOD_S, NOISE), CORE)
        self.core = self.cores[0]

    def feed(self, inputs: Inputs) -> Any:
        for name, value in inputs.items():
            self.core["inputs"][name] = value
        take_sample(self.core["settings"], self.core["inputs"], self.core["sample"])
        return self.core["sample"]

    def feed_all(self, stream: Iterable[Inputs]) -> Any:
        for inputs in stream:
            sample = self.feed(inputs)
        return sample


def sound(force_n: float = 0.0, velocity_m_s: float = 0.0, displacement_m: float = 0.0) -> Inputs:
    """What a sound rig delivers: the chambers agree with the load cell."""
    return {
        "force_n": force_n + RNG.normal(0.0, 8.0),
        "velocity_m_s": velocity_m_s + RNG.normal(0.0, 0.2e-3),
        "displacement_m": displacement_m,
        "pressure_1_pa": 10e6 + force_n / 2.592e-3,
        "pressure_2_pa": 10e6,
        "supply_pressure_pa": 21e6,
    }


@pytest.fixture
def converters() -> Converters:
    made = Converters()
    made.feed_all(sound() for _ in range(400))
    return made


def test_a_sound_rig_has_sound_sensors(converters: Converters) -> None:
    times = np.arange(4000) * PERIOD_S
    swings = 20e3 * np.sin(2 * np.pi * 50 * times)
    places = 2e-3 * np.sin(2 * np.pi * 4 * times)
    for force_n, place_m in zip(swings, places, strict=True):
        sample = converters.feed(sound(force_n, 0.0, place_m))
        assert sensors_are_sound(sample)


SPOILT: dict[str, tuple[str, Callable[[], Inputs], SensorFault]] = {
    "no number": ("force", lambda: sound() | {"force_n": np.nan}, SensorFault.NOT_A_NUMBER),
    "infinite": ("velocity", lambda: sound() | {"velocity_m_s": np.inf}, SensorFault.NOT_A_NUMBER),
    "at its rail": ("force", lambda: sound(60e3) | {"force_n": 60e3}, SensorFault.SATURATED),
    "at its other rail": (
        "velocity",
        lambda: sound() | {"velocity_m_s": -0.5},
        SensorFault.SATURATED,
    ),
    "LVDT at its rail": ("displacement", lambda: sound(0, 0, 0.035), SensorFault.SATURATED),
    "LVDT jumps": ("displacement", lambda: sound(0, 0, 1.1e-3), SensorFault.IMPLAUSIBLE),
    "below nothing": (
        "pressure",
        lambda: sound() | {"supply_pressure_pa": -0.3e6},
        SensorFault.OUT_OF_RANGE,
    ),
    "pressure at its rail": (
        "pressure",
        lambda: sound() | {"supply_pressure_pa": 40e6},
        SensorFault.SATURATED,
    ),
}


@pytest.mark.parametrize("what", SPOILT)
def test_a_fault_that_one_code_tells_is_told_in_its_tick(what: str, converters: Converters) -> None:
    sensor, spoil, fault = SPOILT[what]
    sample = converters.feed(spoil())
    assert sample[sensor]["fault"] == fault
    assert not sensors_are_sound(sample)


@pytest.mark.parametrize(("sensor", "column"), [("force", "force_n"), ("velocity", "velocity_m_s")])
def test_a_frozen_sensor_repeats_itself(sensor: str, column: str, converters: Converters) -> None:
    for _ in range(199):
        sample = converters.feed(sound() | {column: 0.0})
        assert sample[sensor]["fault"] == SensorFault.NONE
    faults = [int(converters.feed(sound() | {column: 0.0})[sensor]["fault"]) for _ in range(3)]
    assert faults[-1] == SensorFault.FROZEN


@pytest.mark.parametrize(("sensor", "column"), [("force", "force_n"), ("velocity", "velocity_m_s")])
def test_a_sensor_smoother_than_its_converter_is_noise_free(
    sensor: str, column: str, converters: Converters
) -> None:
    ramp = (sound() | {column: 1e-9 * k} for k in range(600))
    assert converters.feed_all(ramp)[sensor]["fault"] == SensorFault.NOISE_FREE


def test_a_sensor_without_noise_is_not_asked_for_any() -> None:
    quiet = Converters()
    quiet.core["sample"]["force"]["noise"] = 0.0
    assert quiet.feed_all(sound() | {"force_n": 0.0} for _ in range(1000))["force"]["fault"] == 0


def test_a_load_cell_that_contradicts_the_chambers_is_implausible(converters: Converters) -> None:
    inverted = {"pressure_1_pa": 10e6 + 3e3 / 2.592e-3}  # the chambers push with 3 kN
    for _ in range(3):
        sample = converters.feed(sound() | inverted | {"force_n": -3e3 + RNG.normal(0.0, 8.0)})
        assert sample["force"]["fault"] == SensorFault.NONE
    sample = converters.feed(sound() | inverted | {"force_n": -3e3 + RNG.normal(0.0, 8.0)})
    assert sample["force"]["fault"] == SensorFault.IMPLAUSIBLE
    assert sensors_are_sound(converters.feed(sound()))


def test_an_lvt_that_drifts_from_the_lvdt_is_implausible(converters: Converters) -> None:
    drifting = (sound(0.0, 0.15) for _ in range(4000))
    assert converters.feed_all(drifting)["velocity"]["fault"] == SensorFault.IMPLAUSIBLE


def test_what_was_no_number_leaves_nothing_behind(converters: Converters) -> None:
    converters.feed(dict.fromkeys(sound(), float("nan")))
    for _ in range(3):
        sample = converters.feed(sound())
    assert sensors_are_sound(sample)
