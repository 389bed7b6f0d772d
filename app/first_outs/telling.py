"""What the loop reported around a first-out, in words and in times from it."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from app.first_outs.account import EventKept, TripKept
from app.link.events import describe
from app.link.words import trip_code
from rtcore.codes import EventKind
from rtcore.interlocks import Action, Quantity

Records = npt.NDArray[Any]


class Teller:
    """Says events in words and in times from the first-out; `names` are those of the detectors, where known."""

    def __init__(
        self, period_ns: int, detectors: Records, names: Sequence[str] | None, tick: int
    ) -> None:
        self._period_ns = period_ns
        self._detectors = detectors
        self._names = names
        self._tick = tick

    def time_s(self, tick: int) -> float:
        return round((tick - self._tick) * self._period_ns * 1e-9, 9)

    def trips(self, events: Records) -> list[TripKept]:
        """What tripped, in order."""
        tripped = events[events["kind"] == EventKind.TRIP]
        return [self._trip(i, event) for i, event in enumerate(tripped)]

    def order_of(self, events: Records, event: Any) -> int:
        """The place of the first-out among the trips."""
        tripped = events[events["kind"] == EventKind.TRIP]
        return int(np.flatnonzero(tripped["sequence"] == event["sequence"])[0])

    def events(self, events: Records) -> list[EventKept]:
        """All that was reported."""
        return [self._event(event) for event in events]

    def _trip(self, order: int, event: Any) -> TripKept:
        told = describe(event, self._detectors, self._period_ns)
        place = int(event["code"])
        quantity, action = "unknown", Action.STOP
        if place < len(self._detectors):
            detector = self._detectors[place]
            quantity = Quantity(int(detector["quantity"])).name.lower()
            action = Action(int(detector["action"]))
        return TripKept(
            order=order,
            tick=told.tick,
            time_s=self.time_s(told.tick),
            detector=self._name(place),
            quantity=quantity,
            action=action.name.lower(),
            text=told.text,
            value=finite(told.value),
            limit=finite(told.limit),
        )

    def _name(self, place: int) -> str:
        if self._names is not None and place < len(self._names):
            return self._names[place]
        known = place < len(self._detectors)
        return trip_code(self._detectors[place]) if known else f"detector_{place}"

    def _event(self, event: Any) -> EventKept:
        told = describe(event, self._detectors, self._period_ns)
        return EventKept(
            tick=told.tick,
            time_s=self.time_s(told.tick),
            kind=told.kind,
            code=self._name(int(event["code"])) if told.kind == "trip" else told.code,
            text=told.text,
            value=finite(told.value),
            limit=finite(told.limit),
        )


def finite(value: float) -> float | None:
    """JSON has neither NaN nor infinity."""
    return value if math.isfinite(value) else None
