"""Tests that are put together here, played on the virtual rig by the very tick."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.definitions.reading import definition_from
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.prediction.setup import Setup
from app.prediction.simulation import simulate
from app.recording.outcome import Outcome
from rtcore.rig.parameters import RigParameters, load_rig

Blocks = Sequence[Mapping[str, Any]]
Floats = npt.NDArray[np.float64]
PERIOD_S = RIG.period_s


class Played(NamedTuple):
    """A run: its definition and (n,) TELEMETRY, from the first tick of its program."""

    definition: Definition
    records: npt.NDArray[Any]

    def channel(self, name: str) -> Floats:
        """(n,) of a channel."""
        return np.asarray(self.records[name], np.float64)

    @property
    def time_s(self) -> Floats:
        """(n,) from the first tick."""
        return times(len(self.records))


def times(ticks: int) -> Floats:
    """(n,) from 0 (s)."""
    return np.arange(ticks, dtype=np.float64) * PERIOD_S


def play(
    blocks: Blocks,
    motion: Blocks = (),
    *,
    compensation: str = "auto",
    rig: RigParameters | None = None,
    controller: ControllerSettings | None = None,
    seed: int = 1,
) -> Played:
    """Play a test to its end. Raises RuntimeError where it is refused or trips: then it is none of the paper's."""
    data = {
        "schema": 1,
        "name": "Reproduction",
        "controller": {"compensation": compensation},
        "blocks": list(blocks),
        "motion": list(motion),
    }
    definition = definition_from(data)
    if isinstance(definition, Refusal):
        raise RuntimeError(definition.detail)
    settings = controller or ControllerSettings()
    found = simulate(Setup(definition, rig or load_rig(), settings, default_interlocks(), seed))
    if isinstance(found, Refusal):
        raise RuntimeError(found.detail)
    if found.run.ending.outcome is not Outcome.COMPLETED:
        raise RuntimeError(f"The test did not end by itself: {found.run.ending.reason}")
    return Played(definition, found.run.records)


def fitted(values: Floats, frequency_hz: float) -> complex:
    """Amplitude and phase of a sine in (n,) values, by least squares with a mean: as a complex number."""
    turns = 2j * np.pi * frequency_hz * PERIOD_S * np.arange(len(values))
    parts = np.stack([np.ones(len(values)), np.exp(turns).real, np.exp(turns).imag], axis=1)
    _, real, imaginary = np.linalg.lstsq(parts, values, rcond=None)[0]
    return complex(real, -imaginary)
