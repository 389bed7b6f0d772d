"""What every detector sees at this moment, read off the block: no lock, no database, no wait."""

from collections import Counter
from threading import Lock
from typing import Any

from app.errors import Code, Refusal
from app.interlocks.detector import Detector
from app.interlocks.loop_table import is_of
from app.interlocks.margin import margin, share
from app.interlocks.schemas import DetectorState, LiveDetector, LiveInterlocks
from app.interlocks.table import Interlocks
from app.link.life import Life, RingReader
from app.link.link import Link
from app.link.words import Judging
from rtcore.codes import EventKind
from rtcore.modes import Mode

_LOST = Refusal(Code.LOOP_LOST, "The loop process does not run: nothing watches the rig")
_ANOTHER = Refusal(Code.BUSY, "The loop has not taken its interlocks over yet: try again")


class LiveTable:
    """Reads the detectors of the present loop, and counts their trips since this console was started."""

    def __init__(self, link: Link, interlocks: Interlocks) -> None:
        self._link = link
        self._interlocks = interlocks
        self._counting = Lock()
        self._trips: Counter[str] = Counter()
        self._events: tuple[Life, RingReader] | None = None

    def turn_to(self, interlocks: Interlocks) -> None:
        """Read with this table from now on; what has tripped until now did so under the one before."""
        with self._counting:
            self._count()
            self._interlocks = interlocks

    def read(self) -> LiveInterlocks | Refusal:
        """All detectors, in the order of the table."""
        life, table = self._link.life, self._interlocks
        record = None if life is None or not life.alive else life.snapshot()
        if life is None or record is None:
            return _LOST
        if not is_of(life, table):
            return _ANOTHER
        with self._counting:
            self._count()
            trips = dict(self._trips)
        fields = life.block.fields
        values, ticks = fields["detector_values"].copy(), fields["detector_ticks"].copy()
        latched, first = int(record["trips"]), int(fields["first_out"])
        seen = _Seen(Mode(int(record["mode"])), latched, first, life.period_ns * 1e-9)
        return LiveInterlocks(
            tick=int(record["tick"]),
            mode=seen.mode.name.lower(),
            detectors=[
                seen.detector(i, d, float(values[i]), int(ticks[i]), trips.get(d.name, 0))
                for i, d in enumerate(table.detectors)
            ],
        )

    def _count(self) -> None:
        life = self._link.life
        if life is None:
            return
        if self._events is None or self._events[0] is not life:
            self._events = (life, life.events())
        names = [d.name for d in self._interlocks.detectors]
        events: Any = self._events[1].read().records
        for code in events["code"][events["kind"] == EventKind.TRIP] if len(events) else ():
            if 0 <= code < len(names):
                self._trips[names[code]] += 1


class _Seen:
    """What holds for all detectors at a tick."""

    def __init__(self, mode: Mode, latched: int, first: int, period_s: float) -> None:
        self.mode = mode
        self._latched = latched
        self._first = first
        self._period_s = period_s

    def detector(self, i: int, d: Detector, value: float, ticks: int, trips: int) -> LiveDetector:
        """A detector at this tick."""
        left, judging = margin(d, value), Judging.of_detector(d)
        return LiveDetector(
            name=d.name,
            value=value if left is not None else None,
            text=judging.write(value),
            limit=judging.limit(),
            unit=d.unit,
            margin=left,
            margin_share=share(d, left),
            violated_s=ticks * self._period_s,
            state=self._state(i, d, ticks),
            first_out=i == self._first,
            trips=trips,
        )

    def _state(self, i: int, d: Detector, ticks: int) -> DetectorState:
        if self._latched >> i & 1:
            return DetectorState.TRIPPED
        if not d.enabled:
            return DetectorState.OFF
        if self.mode not in d.armed:
            return DetectorState.NOT_ARMED
        return DetectorState.COUNTING if ticks > 0 else DetectorState.CONTENT
