"""Run a definition on the virtual rig, and measure what came of it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.documents.refusal import Problem, refuse
from app.documents.units import say
from app.errors import Code, Refusal
from app.interlocks.record import to_record as interlocks_record
from app.interlocks.table import Interlocks
from app.link.events import LoopEvent, describe
from app.prediction.judgement import Judged, judge_run, needs_reference
from app.recording.outcome import Ending, Outcome, ending_of
from rtcore.codes import Reply
from rtcore.rig.parameters import RigParameters
from rtcore.virtual import Virtual

LONGEST_S = 1800.0  # all of its ticks are kept in memory, half a megabyte a second
RUN_NUMBER = 1

Progress = Callable[[float], None]  # told the share that is done, 0…1


@dataclass(frozen=True)
class Setup:
    """Everything that decides what a simulation gives, to the bit."""

    definition: Definition
    rig: RigParameters
    controller: ControllerSettings
    interlocks: Interlocks
    seed: int = 1


@dataclass(frozen=True)
class Run:
    """A run on the virtual rig: (n,) TELEMETRY, and what the loop reported of it."""

    records: npt.NDArray[Any]
    events: tuple[LoopEvent, ...]
    ending: Ending


@dataclass(frozen=True)
class Simulation:
    """A run on the virtual rig, how it was made and what it amounts to."""

    setup: Setup
    run: Run
    judged: Judged


def simulate(setup: Setup, progress: Progress | None = None) -> Simulation | Refusal:
    """Pressurise the virtual rig, run the test to its end and measure it.

    A test that asks for a comparison is run once more with the next seed. Refused where the test is
    too long to keep, or where this rig cannot be made ready or cannot run it.
    """
    duration_s = outline(setup.definition).duration_s
    if duration_s > LONGEST_S:
        message = f"a simulation of {say(duration_s, 's')} must last at most {say(LONGEST_S, 's')}"
        problem = Problem("blocks", duration_s, message, limit=LONGEST_S, unit="s")
        return refuse(Code.INVALID_TEST, setup.definition.name, [problem])
    runs = 2 if needs_reference(setup.definition) else 1
    part = _Part(progress or (lambda share: None), duration_s, runs)
    run = _run(setup, setup.seed, part)
    if isinstance(run, Refusal):
        return run
    reference = None
    if runs == 2 and run.ending.outcome is Outcome.COMPLETED:
        again = _run(setup, setup.seed + 1, part)
        reference = again.records if isinstance(again, Run) else None
    limit = setup.controller.valve_limit
    judged = judge_run(setup.definition, run.records, RIG.period_s, limit, reference)
    return Simulation(setup, run, judged)


def _run(setup: Setup, seed: int, part: "_Part") -> Run | Refusal:
    interlocks = interlocks_record(setup.interlocks, RIG.period_s)
    gains = gains_record(setup.controller)
    virtual = _Watched(gains, interlocks, setup.rig, seed, RIG.period_s)
    try:
        virtual.bring_to_ready()
    except RuntimeError as error:
        return Refusal(Code.INVALID_REQUEST, f"The virtual rig does not become ready: {error}")
    if virtual.load_program(expand(setup.definition)) != Reply.ACCEPTED:
        detail = "The test goes beyond the limits of this rig: compare the stroke of its unit"
        return Refusal(Code.INVALID_BANK, detail)
    virtual.events()  # of getting ready
    virtual.watch(part)
    records = virtual.run(RUN_NUMBER)
    part.done += 1
    detectors = interlocks["detectors"][: int(interlocks["count"])]
    period_ns = round(RIG.period_s * 1e9)
    events = tuple(describe(event, detectors, period_ns) for event in virtual.events())
    return Run(records, events, ending_of(events))


@dataclass
class _Part:
    """How far one or two runs have got together."""

    progress: Progress
    duration_s: float
    runs: int
    done: int = 0

    def advanced(self, ticks: int) -> None:
        """So many ticks of the present run have gone by."""
        share = min(1.0, ticks * RIG.period_s / self.duration_s)
        self.progress((self.done + share) / self.runs)


class _Watched(Virtual):
    """A virtual rig that says how far it has got."""

    _part: _Part | None = None
    _since: int = 0

    def watch(self, part: _Part) -> None:
        """Count the ticks from now on."""
        self._part, self._since = part, self.tick

    def advance(self, ticks: int) -> npt.NDArray[Any]:
        """As of any virtual rig."""
        records = super().advance(ticks)
        if self._part is not None:
            self._part.advanced(self.tick - self._since)
        return records
