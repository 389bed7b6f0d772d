"""Tests of frequency responses on the virtual rig, and what they give."""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from app.analysis.response.point import ResponsePoint
from app.conducting.responding import Responding
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.interlocks.defaults import default_interlocks
from app.prediction.play import Play, made_ready
from app.prediction.setup import Setup
from app.recording.outcome import Outcome
from rtcore.rig.parameters import load_rig


def response_test(**block: Any) -> Definition:
    """A test of one frequency response."""
    asked = {"kind": "frequency_response", "amplitudes_n": [2000.0], **block}
    return Definition.model_validate({"schema": 1, "name": "response", "blocks": [asked]})


@dataclass(frozen=True)
class Played:
    """A run on the virtual rig: its ticks, its skips and its points of the closed loop."""

    records: Any
    skips: int
    refusals: int
    points: list[ResponsePoint]

    @property
    def duration_s(self) -> float:
        return len(self.records) * RIG.period_s

    def by_frequency(self) -> dict[float, ResponsePoint]:
        """Rounded to a hundredth of a hertz."""
        return {round(point.frequency_hz, 2): point for point in self.points}


@cache
def play(definition: Definition) -> Played:
    """A whole test; the same one is played once."""
    return played(definition)


def played(definition: Definition, seed: int = 1) -> Played:
    """A whole test."""
    setup = Setup(definition, load_rig(), ControllerSettings(), default_interlocks(), seed)
    ready = made_ready(setup)
    assert isinstance(ready, Play)
    records = np.concatenate(list(ready.chunks()))
    assert ready.ending.outcome is Outcome.COMPLETED
    kinds = [event.kind for event in ready.events]
    points = points_of(definition, records)
    return Played(records, kinds.count("skipped"), kinds.count("refusal"), points)


def points_of(definition: Definition, records: Any, transfer: str = "force") -> list[ResponsePoint]:
    """The points of a recorded run."""
    responding = Responding(definition, RIG.period_s)
    responding.take(records)
    found = [found.point for found in responding.points()]
    return [point for point in found if point.transfer == transfer]
