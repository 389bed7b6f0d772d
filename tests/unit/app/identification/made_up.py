"""Windows and recordings for the tests of the identification."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.identification.model import DISPLACEMENT, MEASURED, Model
from app.identification.windows import LENGTH, RUN_UP, Window
from app.interlocks.defaults import default_interlocks
from app.prediction.setup import Setup
from app.prediction.simulation import Simulation, simulate
from app.recording.bins import Columns
from rtcore.rig.parameters import RigParameters

Floats = npt.NDArray[np.float64]
PERIOD_S = 250e-6

# Half a minute of everything that tells of a rig.
SHORT: dict[str, Any] = {
    "schema": 1,
    "name": "Short",
    "blocks": [
        {"kind": "hold", "force_n": 0, "duration_s": 9},
        {"kind": "sweep", "amplitude_n": 2000, "from_hz": 2, "to_hz": 150, "duration_s": 6},
        {"kind": "sweep", "amplitude_n": 2000, "from_hz": 100, "to_hz": 260, "duration_s": 4},
        {"kind": "step", "to_n": 6000, "hold_s": 0.5},
        {"kind": "step", "to_n": -6000, "hold_s": 0.5},
        {"kind": "step", "to_n": 2000, "hold_s": 0.5},
        {"kind": "ramp", "to_n": 30000, "duration_s": 2},
        {"kind": "ramp", "to_n": 0, "duration_s": 2},
    ],
    "motion": [
        {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 0.5, "duration_s": 2},
        {"kind": "harmonic", "amplitude_m": 0.01, "frequency_hz": 2, "duration_s": 2},
    ],
}


class Kept:
    """The ticks of a simulation, as samples on disk give them."""

    def __init__(self, records: npt.NDArray[Any]) -> None:
        self.records = records
        self.first_tick = int(records["tick"][0])
        self.last_tick = int(records["tick"][-1])

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        """The columns between two ticks."""
        ticks = self.records["tick"]
        inside = self.records[(ticks >= first_tick) & (ticks <= last_tick)]
        yield {name: inside[name] for name in ("tick", *names)}

    def levels(self) -> tuple[()]:
        """None."""
        return ()


def recorded(rig: RigParameters, data: dict[str, Any], seed: int = 1) -> Kept:
    """A test on a virtual rig, loop, noise and converters and all."""
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    setup = Setup(definition, rig, ControllerSettings(), default_interlocks(), seed)
    simulation = simulate(setup)
    assert isinstance(simulation, Simulation), simulation.detail
    return Kept(simulation.run.records)


def noise_free(rig: RigParameters, count: int) -> list[Window]:
    """Windows of a rig that is driven by chance, with ideal sensors: each begins where the one before ended."""
    chance = np.random.default_rng(3)
    start = np.zeros(len(MEASURED) + 1)
    start[1:4] = 10.65e6, 10.65e6, 21e6
    model, windows = Model(rig, PERIOD_S), []
    for _ in range(count):
        drive = np.empty((RUN_UP + LENGTH, 2))
        drive[:, 0] = 0.05 * np.repeat(chance.standard_normal(len(drive) // 8), 8)
        seconds = np.arange(len(drive)) * PERIOD_S
        drive[:, 1] = start[DISPLACEMENT] + 0.004 * np.sin(2 * np.pi * 5 * seconds)
        found = model.driven(start, drive)
        windows.append(Window(0, 0, start.copy(), drive, found[RUN_UP:].copy()))
    return windows
