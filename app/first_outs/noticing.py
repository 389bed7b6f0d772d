"""Notices first-outs in what the loop reports: a trip that takes the load off, while none is latched."""

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import Any

import numpy as np
import numpy.typing as npt

from app.first_outs.account import Step
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action
from rtcore.modes import Mode, is_run

Records = npt.NDArray[Any]
OPERATED = (
    *(Opcode.HOLD, Opcode.RESUME, Opcode.STOP, Opcode.SHUTDOWN),
    *(Opcode.RESET, Opcode.PRESSURISE, Opcode.DEPRESSURISE),
)
LEAD_S = 20.0  # before a first-out outside a run that are re-run
MOST_STEPS = 1000


@dataclass(frozen=True)
class Noticed:
    """A first-out: its trip (an EVENT record), and what led to it."""

    event: Any
    run_began: int | None  # tick; None outside a run
    began: Mode  # in which the steps begin
    steps: tuple[Step, ...]
    injected: dict[int, float]  # kinds of faults and their amounts

    @property
    def tick(self) -> int:
        return int(self.event["tick"])

    @property
    def detector(self) -> int:
        """Its place in the table."""
        return int(self.event["code"])


class Noticer:
    """Follows the events of one life of the loop, in order."""

    def __init__(self, period_s: float) -> None:
        self._lead_ticks = round(LEAD_S / period_s)
        self._latched = False
        self._mode = Mode.TRIPPED
        self._run_began: int | None = None
        self._began = Mode.TRIPPED
        self._steps: deque[Step] = deque(maxlen=MOST_STEPS)
        self._modes: deque[tuple[int, Mode]] = deque(maxlen=MOST_STEPS)  # from which tick on
        self._injected: dict[int, float] = {}

    def take(self, events: Records, detectors: Records) -> Iterator[Noticed]:
        """The first-outs among (n,) EVENT, whole ticks of them; `detectors` is the table in force."""
        for tick, together in groupby(events, key=lambda event: int(event["tick"])):
            found = list(together)
            trips = [e for e in found if _takes_load_off(e, detectors)]
            if trips and not self._latched:
                yield self._noticed(max(trips, key=lambda e: _rank(e, detectors)))
            self._latched = self._latched or bool(trips)
            for event in found:
                self._follow(tick, event)

    def _noticed(self, event: Any) -> Noticed:
        tick = int(event["tick"])
        in_run = self._run_began is not None and is_run(self._mode)
        since = (
            self._run_began if in_run and self._run_began is not None else tick - self._lead_ticks
        )
        steps = tuple(s for s in self._steps if s.tick >= since)
        earlier = [mode for began, mode in self._modes if began <= since]
        began = Mode.RUNNING if in_run else (earlier[-1] if earlier else Mode.TRIPPED)
        return Noticed(
            event, self._run_began if in_run else None, began, steps, dict(self._injected)
        )

    def _follow(self, tick: int, event: Any) -> None:
        kind, code = int(event["kind"]), int(event["code"])
        if kind == EventKind.MODE:
            self._mode = Mode(code)
            self._modes.append((tick, self._mode))
        elif kind == EventKind.FAULT:
            self._inject(tick, code, float(event["value"]))
        elif kind == EventKind.SKIPPED:
            self._step(tick, Opcode.SKIP, code, float(event["value"]))
        elif kind == EventKind.STOP_ASKED:
            self._step(tick, Opcode.STOP)
        elif kind == EventKind.COMMAND and int(event["value"]) == Reply.ACCEPTED:
            self._obeyed(tick, code)

    def _obeyed(self, tick: int, opcode: int) -> None:
        if opcode == Opcode.RESET:
            self._latched = False
        if opcode == Opcode.START:
            self._run_began = tick
            self._steps.clear()
            for kind, amount in self._injected.items():
                self._step(tick, Opcode.INJECT_FAULT, kind, amount)
        elif opcode in OPERATED:
            self._step(tick, Opcode(opcode))

    def _inject(self, tick: int, kind: int, amount: float) -> None:
        self._injected.pop(kind, None)
        if amount != 0.0:
            self._injected[kind] = amount
        self._step(tick, Opcode.INJECT_FAULT, kind, amount)

    def _step(self, tick: int, opcode: Opcode, argument: int = 0, value: float = 0.0) -> None:
        named = opcode.name.lower()
        self._steps.append(Step(tick=tick, opcode=named, argument=argument, value=value))


def _action(event: Any, detectors: Records) -> int:
    place = int(event["code"])
    return int(detectors[place]["action"]) if place < len(detectors) else int(Action.STOP)


def _takes_load_off(event: Any, detectors: Records) -> bool:
    return bool(event["kind"] == EventKind.TRIP) and _action(event, detectors) >= Action.STOP


def _rank(event: Any, detectors: Records) -> tuple[int, int]:
    """The strongest action counts as the first of several in a tick, then the table's order."""
    return _action(event, detectors), -int(event["code"])


def resets_in(events: Records) -> list[int]:
    """The ticks in which a reset was obeyed."""
    obeyed = (events["kind"] == EventKind.COMMAND) & (events["code"] == Opcode.RESET)
    accepted = events["value"] == Reply.ACCEPTED
    return [int(tick) for tick in np.unique(events["tick"][obeyed & accepted])]
