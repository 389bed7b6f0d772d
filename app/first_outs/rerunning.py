"""A first-out once more on the virtual rig: the very tick of the loop, the same test, seed and faults."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from app.controller.record import to_record as gains_record
from app.definitions.limits import RIG
from app.first_outs.account import PeakKept, Step, TripKept
from app.first_outs.box import AROUND_S
from app.first_outs.changes import InForceThen
from app.first_outs.peaks import peaks_of
from app.first_outs.scene import Scene
from app.first_outs.telling import Teller
from app.first_outs.words import first_out_among
from app.interlocks.record import to_record as interlocks_record
from rtcore.codes import Opcode, Reply
from rtcore.interlocks import Quantity
from rtcore.virtual import Virtual

Records = npt.NDArray[Any]
Progress = Callable[[float], None]  # told the share that is done, 0…1

RUN = 1
RESTED_S = 1.0  # after it is ready, as before any test on a rig
SETTLED_S = 2.0  # of a test that is begun in its midst, before its detectors look
_AROUND = round(AROUND_S / RIG.period_s)  # ticks
_TOGETHER = 4000
_TWIN = (Quantity.TWIN_RESIDUAL_N, Quantity.TWIN_GOODNESS, Quantity.TWIN_SPOOL)


class CannotRerun(Exception):
    """The virtual rig cannot be brought to where the first-out began."""


@dataclass(frozen=True)
class Played:
    """The ticks around the first-out's, (n,) TELEMETRY; `tick` is that at which it was recorded."""

    records: Records
    tick: int
    trips: list[TripKept]
    first_out: TripKept | None
    peaks: list[PeakKept]


class _Rig(Virtual):
    """A virtual rig that keeps its last ticks: as many as there are around a first-out."""

    def __init__(self, then: InForceThen) -> None:
        self.kept: deque[Records] = deque()
        twin = any(d.enabled and d.quantity in _TWIN for d in then.interlocks.detectors)
        gains = gains_record(then.controller)
        table = interlocks_record(then.interlocks, RIG.period_s)
        super().__init__(gains, table, then.rig, then.seed, RIG.period_s, twin=twin)

    def advance(self, ticks: int) -> Records:
        """As of any virtual rig."""
        records = super().advance(ticks)
        if len(records):
            self.kept.append(records)
        while self.kept and self.kept[0]["tick"][-1] < self.tick - 2 * _AROUND - 1:
            self.kept.popleft()
        return records

    def until(self, tick: int, told: Callable[[int], None]) -> None:
        """Go on to where this tick comes next."""
        while self.tick < tick:
            self.advance(min(_TOGETHER, tick - self.tick))
            told(self.tick)


def play(scene: Scene, then: InForceThen, progress: Progress) -> Played:
    """Play a scene to two seconds after the first-out. Raises `CannotRerun`."""
    try:
        rig = _Rig(then)
        origin = _begin(rig, scene)
    except (RuntimeError, ValueError) as error:
        raise CannotRerun(str(error)) from error
    tick = origin + scene.trip_tick
    last = tick + _AROUND + 1

    def told(now: int) -> None:
        progress(min(1.0, max(0.0, (now - origin) / (last - origin))))

    if scene.begun is not None:
        _settle(rig, origin, told)
    for step in scene.steps:
        rig.until(origin + step.tick, told)
        _take(rig, step)
    rig.until(last, told)
    return _played(rig, then, tick)


def _begin(rig: _Rig, scene: Scene) -> int:
    """Bring the rig to where the scene begins; the tick that counts as its first."""
    if scene.program is None:
        return _begin_outside(rig, scene)
    _make_ready(rig)
    if rig.load_program(scene.program) != Reply.ACCEPTED:
        raise ValueError("the test goes beyond the limits of this rig")
    _break(rig, scene)
    reply = rig.command(Opcode.START, RUN)
    if reply != Reply.ACCEPTED:
        raise ValueError(f"the test was not started: {reply.name.lower()}")
    if scene.begun is not None:
        rig.set_down(*(_next(begun.start) for begun in scene.begun))
    return rig.tick - 1


def _begin_outside(rig: _Rig, scene: Scene) -> int:
    if scene.began not in ("off", "tripped", "pressurising"):
        _make_ready(rig)
    elif scene.began != "tripped":
        rig.command(Opcode.RESET)
    _break(rig, scene)
    if scene.began == "pressurising":
        rig.command(Opcode.PRESSURISE)
    return rig.tick


def _make_ready(rig: _Rig) -> None:
    rig.bring_to_ready()
    rig.advance(round(RESTED_S / RIG.period_s))


def _break(rig: _Rig, scene: Scene) -> None:
    for kind, amount in scene.faults.items():
        rig.command(Opcode.INJECT_FAULT, kind, amount)


def _next(start: Any) -> Any:
    """The tick after a START record's: the one of the start itself has gone by."""
    *state, tick, knots_before = start
    return (*state, tick + 1, knots_before)


def _settle(rig: _Rig, origin: int, told: Callable[[int], None]) -> None:
    """The setpoint begins in mid-swing: until the rig has followed it, that is no error of the rig's."""
    fields = rig.block.fields
    detectors = fields["interlocks"][int(fields["active_interlocks"])]["detectors"]
    enabled = detectors["enabled"].copy()
    detectors["enabled"] = 0
    rig.until(origin + round(SETTLED_S / RIG.period_s), told)
    detectors["enabled"] = enabled


def _take(rig: _Rig, step: Step) -> None:
    """Give a command again; what the rig does not take now, it does not take."""
    opcode = Opcode[step.opcode.upper()]
    rig.command(opcode, step.argument, step.value)


def _played(rig: _Rig, then: InForceThen, tick: int) -> Played:
    records = np.concatenate(rig.kept)
    records = records[np.abs(records["tick"] - tick) <= _AROUND]
    events = rig.events()
    table = rig.block.fields["interlocks"][int(rig.block.fields["active_interlocks"])]
    names = [d.name for d in then.interlocks.detectors]
    detectors = table["detectors"][: int(table["count"])]
    period_ns = round(RIG.period_s * 1e9)
    trips = Teller(period_ns, detectors, names, tick).trips(events)
    return Played(
        records, tick, trips, first_out_among(trips, names), peaks_of(records, tick, RIG.period_s)
    )
