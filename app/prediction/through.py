"""A definition run to its end on the virtual rig and measured on the way, with memory that does not grow."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
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

Sink = Callable[[Records], None]  # is given the ticks of the run, (n,) TELEMETRY at a time


@dataclass(frozen=True)
class Series:
    """Force (N) and displacement (m) at each tick of the program from its first, (n,) float32."""

    force_n: npt.NDArray[np.float32]
    displacement_m: npt.NDArray[np.float32]

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
    kept = int(watch.seen["kept"])
    return Series(watch.force_n[:kept], watch.displacement_m[:kept])


def run_through(
    setup: Setup, progress: Progress = ignore, sink: Sink | None = None
) -> Through | Refusal:
    """Pressurise the virtual rig, run the test to its end and measure it.

    A test that asks for a comparison is run with the next seed before. Refused where this rig cannot be made
    ready or cannot run it; an exception in `progress` or `sink` ends it.
    """
    reference = None
    shares = 1.0
    if needs_reference(setup.definition):
        shares = 0.5
        reference = _reference(setup, lambda share: progress(0.5 * share))
    play = made_ready(setup, KEPT_TICKS)
    if isinstance(play, Refusal):
        return play
    measure = measuring(
        setup.definition, RIG.period_s, setup.controller.valve_limit, reference, None
    )
    ticks = 0
    for chunk in play.chunks(lambda share: progress(1.0 - shares + shares * share)):
        measure.take(chunk)
        ticks += len(chunk)
        if sink is not None:
            sink(chunk)
    completed = play.ending.outcome is Outcome.COMPLETED
    judged = judge_measured(setup.definition, measure.result(), completed=completed)
    return Through(setup, ticks, play.watch, tuple(play.events), play.ending, judged)


def _reference(setup: Setup, progress: Progress) -> Predicted | None:
    other = Setup(setup.definition, setup.rig, setup.controller, setup.interlocks, setup.seed + 1)
    play = made_ready(other, KEPT_TICKS)
    if not isinstance(play, Play):
        return None
    for _ in play.chunks(progress):
        pass
    if play.ending.outcome is not Outcome.COMPLETED:
        return None
    return Predicted(series_of(play.watch).chunks())
