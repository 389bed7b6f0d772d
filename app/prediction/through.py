"""A definition run to its end on the virtual rig and measured on the way, with memory that does not grow."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.predicted import Predicted
from app.definitions.limits import RIG
from app.errors import Refusal
from app.link.events import LoopEvent
from app.prediction.judgement import Judged, judge_measured, measuring, needs_reference
from app.prediction.play import Play, Progress, Records, ignore, made_ready
from app.prediction.setup import Setup
from app.prediction.watch import Watch
from app.recording.outcome import Ending, Outcome

KEPT_S = 600.0  # of force and displacement: 20 MB
KEPT_TICKS = round(KEPT_S / RIG.period_s)


@dataclass(frozen=True)
class Series:
    """Force (N) and displacement (m) at each tick of the program from its first, (n,) float32."""

    force_n: npt.NDArray[np.float32]
    displacement_m: npt.NDArray[np.float32]

    @property
    def nbytes(self) -> int:
        """What both take."""
        return self.force_n.nbytes + self.displacement_m.nbytes

    def chunks(self) -> Iterable[dict[str, Any]]:
        """As `app.analysis.predicted.Predicted` takes it."""
        yield {"program_tick": np.arange(len(self.force_n)), "force_n": self.force_n}


@dataclass(frozen=True)
class Through:
    """A run on the virtual rig: what was seen, what the loop reported, and what it amounts to."""

    setup: Setup
    ticks: int
    watch: Watch
    events: tuple[LoopEvent, ...]
    ending: Ending
    judged: Judged

    @property
    def series(self) -> Series:
        """Its force and displacement, as far as they were kept."""
        return series_of(self.watch)


def series_of(watch: Watch) -> Series:
    """What a watch has kept."""
    return Series(watch.force_n, watch.displacement_m)


class Passage:
    """A run on the virtual rig that is under way: take its chunks, then ask what it amounts to."""

    def __init__(self, play: Play, reference: Predicted | None, progress: Progress) -> None:
        setup = play.setup
        self._play = play
        self._progress = progress
        self._measuring = measuring(
            setup.definition, RIG.period_s, setup.controller.valve_limit, reference
        )
        self._ticks = 0

    def chunks(self) -> Iterator[Records]:
        """The ticks of the run, (n,) TELEMETRY at a time."""
        for chunk in self._play.chunks(self._progress):
            self._measuring.take(chunk)
            self._ticks += len(chunk)
            yield chunk

    def result(self) -> Through:
        """What it amounts to, once all chunks have been taken."""
        play = self._play
        completed = play.ending.outcome is Outcome.COMPLETED
        measured = self._measuring.result()
        judged = judge_measured(play.setup.definition, measured, completed=completed)
        return Through(play.setup, self._ticks, play.watch, tuple(play.events), play.ending, judged)


def begin(setup: Setup, progress: Progress = ignore) -> Passage | Refusal:
    """Pressurise the virtual rig and load the test, ready to run it.

    A test that asks for a comparison is run with the next seed first. Refused where this rig cannot be made
    ready or cannot have the test; an exception in `progress` ends whatever is under way.
    """
    if not needs_reference(setup.definition):
        play = made_ready(setup, KEPT_TICKS)
        return play if isinstance(play, Refusal) else Passage(play, None, progress)
    reference = _reference(setup, lambda share: progress(0.5 * share))
    play = made_ready(setup, KEPT_TICKS)
    if isinstance(play, Refusal):
        return play
    return Passage(play, reference, lambda share: progress(0.5 + 0.5 * share))


def run_through(setup: Setup, progress: Progress = ignore) -> Through | Refusal:
    """Run the test to its end, keeping no more than what it amounts to."""
    passage = begin(setup, progress)
    if isinstance(passage, Refusal):
        return passage
    for _ in passage.chunks():
        pass
    return passage.result()


def _reference(setup: Setup, progress: Progress) -> Predicted | None:
    play = made_ready(replace(setup, seed=setup.seed + 1), KEPT_TICKS)
    if not isinstance(play, Play):
        return None
    for _ in play.chunks(progress):
        pass
    completed = play.ending.outcome is Outcome.COMPLETED
    return Predicted(series_of(play.watch).chunks()) if completed else None
