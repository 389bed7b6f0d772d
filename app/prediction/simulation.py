"""Run a whole definition on the virtual rig: every tick for whoever takes it, and a prediction of it all."""

import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from app.errors import Refusal
from app.link.events import LoopEvent
from app.prediction.judgement import Judged
from app.prediction.play import Progress, Records, ignore
from app.prediction.predicting import prediction_of
from app.prediction.schemas import Prediction
from app.prediction.setup import Setup
from app.prediction.shortening import Shortened
from app.prediction.through import Passage, Through, begin
from app.recording.outcome import Ending


@dataclass(frozen=True)
class Run:
    """A run on the virtual rig, all of it: (n,) TELEMETRY, and what the loop reported of it."""

    records: Records
    events: tuple[LoopEvent, ...]
    ending: Ending


@dataclass(frozen=True)
class Simulation:
    """A run on the virtual rig with all of its ticks, how it was made and what it amounts to."""

    setup: Setup
    run: Run
    judged: Judged


class Simulating:
    """A simulation that is under way: take its chunks, then ask what it amounts to."""

    def __init__(self, setup: Setup, passage: Passage) -> None:
        self._setup = setup
        self._passage = passage
        self._through: Through | None = None
        self._began = time.perf_counter()

    def chunks(self) -> Iterator[Records]:
        """The ticks of the run, (n,) TELEMETRY at a time."""
        yield from self._passage.chunks()

    @property
    def through(self) -> Through:
        """What it amounts to, once all chunks have been taken."""
        if self._through is None:
            self._through = self._passage.result()
        return self._through

    def prediction(self) -> Prediction:
        """The same as a prediction, of every tick of the test."""
        took_s = time.perf_counter() - self._began
        return prediction_of(self._setup, Shortened(self._setup.definition), self.through, took_s)


def begin_simulation(setup: Setup, progress: Progress = ignore) -> Simulating | Refusal:
    """Pressurise the virtual rig and load the test. Refused where this rig cannot have it."""
    passage = begin(setup, progress)
    return passage if isinstance(passage, Refusal) else Simulating(setup, passage)


def simulate(setup: Setup, progress: Progress = ignore) -> Simulation | Refusal:
    """Run a short test and keep every tick of it, half a megabyte a second."""
    simulating = begin_simulation(setup, progress)
    if isinstance(simulating, Refusal):
        return simulating
    records = np.concatenate(list(simulating.chunks()))
    through = simulating.through
    return Simulation(setup, Run(records, through.events, through.ending), through.judged)
