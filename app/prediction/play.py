"""A definition run on the virtual rig, chunk by chunk: however long it is, no more than a second is in memory."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from app.conducting.conducting import LOOK_TICKS, Conducting
from app.controller.record import to_record as gains_record
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.errors import Code, Refusal
from app.interlocks.record import to_record as interlocks_record
from app.link.events import LoopEvent, describe
from app.prediction.setup import Setup
from app.prediction.watch import Watch
from app.recording.outcome import Ending, Outcome, ending_of
from rtcore.codes import Opcode, Reply
from rtcore.modes import Mode
from rtcore.virtual import Virtual

RUN_NUMBER = 1
CHUNK_TICKS = 4000
SETTLED_S = (
    1.0  # after it is ready: the supply comes up to its last bar, as before any test on a rig
)
HELD_S = 1.0  # nobody resumes on the virtual rig: held this long, a run is over
MOST_EVENTS = 2000  # that are kept: a program of a million blocks has a million

Progress = Callable[[float], None]  # told the share that is done, 0…1
Records = npt.NDArray[Any]


def ignore(share: float) -> None:
    """Progress that nobody follows."""


class WatchedRig(Virtual):
    """A virtual rig that is looked at while it runs, and that hands over the ticks of its run."""

    watch: Watch | None = None

    def __init__(self, setup: Setup) -> None:
        self.taken: list[Records] = []
        gains = gains_record(setup.controller)
        interlocks = interlocks_record(setup.interlocks, RIG.period_s)
        super().__init__(gains, interlocks, setup.rig, setup.seed, RIG.period_s)

    def advance(self, ticks: int) -> Records:
        """As of any virtual rig."""
        if self.watch is None:
            return super().advance(ticks)
        records = self._watched(ticks, self.watch)
        mine = records["run"] == RUN_NUMBER
        if mine.any():
            self.taken.append(records if mine.all() else records[mine])
        return records

    def _watched(self, ticks: int, watch: Watch) -> Records:
        slots = len(self.block.ring)
        parts = []
        while ticks > 0:
            first = self.tick
            count = min(ticks, self._feed(slots - first % slots))
            watch.run_ticks(self.io.addresses, first, count, self.app_beats, 0)
            parts.append(self.block.ring[first % slots : first % slots + count].copy())
            ticks -= count
        return np.concatenate(parts) if len(parts) > 1 else parts[0]


@dataclass
class Play:
    """A run on the virtual rig, from the moment at which the rig is ready."""

    setup: Setup
    rig: WatchedRig
    watch: Watch
    ticks: int  # of the program
    events: list[LoopEvent] = field(default_factory=list)
    conducting: Conducting | None = None  # of a test that adapts
    held: bool = False
    first_tick: int = -1  # of the loop, in which the run began

    def chunks(self, progress: Progress = ignore) -> Iterator[Records]:
        """The ticks of the run, (n,) TELEMETRY at a time. Raises RuntimeError where the loop does not start it."""
        rig = self.rig
        rig.events()  # of getting ready
        self.watch.begin(RUN_NUMBER, rig.io.core["violated_ticks"])
        rig.watch = self.watch
        reply = rig.command(Opcode.START, RUN_NUMBER)
        if reply != Reply.ACCEPTED:
            raise RuntimeError(f"start was refused: {reply.name.lower()}")
        self.first_tick = int(rig.taken[0]["tick"][0])
        if self.conducting is not None:
            self.conducting.take(rig.taken[0])
        held_ticks = 0
        while rig.taken:
            yield np.concatenate(rig.taken) if len(rig.taken) > 1 else rig.taken[0]
            rig.taken.clear()
            self._read_events()
            progress(min(1.0, int(self.watch.seen["loaded"]) / max(1, self.ticks)))
            held_ticks = held_ticks + CHUNK_TICKS if rig.mode == Mode.HOLDING else 0
            self.held = held_ticks * RIG.period_s > HELD_S
            if not self.held:
                self._advance()
        self._read_events()
        self.watch.end()
        progress(1.0)

    def _advance(self) -> None:
        """A chunk; where the test adapts, it is decided every so often in it what is left out."""
        rig, conducting = self.rig, self.conducting
        if conducting is None:
            rig.advance(CHUNK_TICKS)
            return
        told = 0
        for _ in range(CHUNK_TICKS // LOOK_TICKS):
            rig.advance(LOOK_TICKS)
            fresh, told = rig.taken[told:], len(rig.taken)
            segment = conducting.take(np.concatenate(fresh)) if fresh else None
            if segment is not None:
                rig.command(Opcode.SKIP, segment)
        if rig.taken[told:]:
            conducting.take(np.concatenate(rig.taken[told:]))

    @property
    def ending(self) -> Ending:
        """How the run ended."""
        if self.held:
            trips = [e.text for e in self.events if e.kind == "trip"]
            return Ending(Outcome.STOPPED, trips[0] if trips else None)
        return ending_of(self.events)

    def _read_events(self) -> None:
        period_ns = round(RIG.period_s * 1e9)
        found = [describe(event, self.watch.detectors, period_ns) for event in self.rig.events()]
        telling = [e for e in found if e.kind != "block"]
        self.events += found if len(self.events) < MOST_EVENTS else telling


def made_ready(setup: Setup, kept_ticks: int = 0) -> Play | Refusal:
    """The virtual rig pressurised and the test loaded. Refused where this rig cannot have it."""
    ticks = round(outline(setup.definition).duration_s / RIG.period_s)
    try:
        rig = _ready(setup)
    except (RuntimeError, ValueError) as error:
        return Refusal(Code.INVALID_REQUEST, f"The virtual rig does not become ready: {error}")
    if int(rig.io.core["blocking"]) != 0:
        detail = "An interlock is latched as soon as the virtual rig is ready: no test could start"
        return Refusal(Code.CAUSE_PRESENT, detail)
    if rig.load_program(expand(setup.definition)) != Reply.ACCEPTED:
        detail = "The test goes beyond the limits of this rig: compare the stroke of its unit"
        return Refusal(Code.INVALID_BANK, detail)
    watch = Watch(
        interlocks_record(setup.interlocks, RIG.period_s),
        setup.controller.valve_limit,
        len(setup.definition.blocks),
        ticks,
        kept_ticks,
        RIG.period_s,
    )
    conducting = Conducting(setup.definition, RIG.period_s)
    return Play(setup, rig, watch, ticks, conducting=conducting if conducting.adapts else None)


def _ready(setup: Setup) -> WatchedRig:
    """A rig at rest; one that does not stay so is taken as it was when it had just become ready."""
    for settles in (True, False):
        rig = WatchedRig(setup)
        rig.bring_to_ready()
        if not settles:
            break
        rig.advance(round(SETTLED_S / RIG.period_s))
        if rig.mode == Mode.READY and int(rig.io.core["blocking"]) == 0:
            break
    return rig
