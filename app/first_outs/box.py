"""The black box: every tick of all channels around a first-out, copied out of the ring."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from time import monotonic_ns
from typing import Any

import numpy as np
import numpy.typing as npt

from app.controller.settings import ControllerSettings
from app.first_outs.account import Account, EventKept, PeakKept, Settings, TripKept
from app.first_outs.noticing import Noticed, resets_in
from app.interlocks.record import to_record
from app.interlocks.table import Interlocks
from app.link.events import describe
from app.link.life import Life
from app.link.words import trip_code
from rtcore.channels import CHANNEL
from rtcore.codes import EventKind
from rtcore.interlocks import Action, Quantity
from rtcore.modes import Mode
from rtcore.replay import Replay
from rtcore.rig.faults import Fault
from rtcore.rig.parameters import RigParameters

Records = npt.NDArray[Any]

AROUND_S = 2.0  # before and after
REMEMBERED_S = 20.0  # before the box, that the loop's check may remember something of
PEAKS = (
    *("force_n", "force_error_n", "displacement_m"),
    *("velocity_m_s", "valve_command", "supply_pressure_pa"),
)
_TOGETHER = 1 << 14


@dataclass(frozen=True)
class InForce:
    """The settings as the console knows them, and who was in command."""

    controller: ControllerSettings
    interlocks: Interlocks
    rig: RigParameters
    seed: int
    lease: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Box:
    """A first-out with its samples, (n,) TELEMETRY."""

    account: Account
    records: Records


def last_tick(noticed: Noticed, life: Life) -> int:
    """The last tick of its box."""
    return noticed.tick + around_ticks(life.period_ns)


def around_ticks(period_ns: int) -> int:
    """Ticks before a first-out, and after it."""
    return round(AROUND_S * 1e9 / period_ns)


def fill_box(life: Life, noticed: Noticed, events: Records, in_force: InForce) -> Box:
    """Copy what the ring still holds of it; `events` are those of this life, as far as they are known."""
    around = around_ticks(life.period_ns)
    first, last = noticed.tick - around, noticed.tick + around
    detectors = life.detectors()
    table = to_record(in_force.interlocks, life.period_ns * 1e-9)
    known = bool(np.array_equal(table["detectors"][: int(table["count"])], detectors))
    remembered: dict[str, Any] = {}
    if known:
        replay = Replay(table, in_force.rig, in_force.controller.valve_limit, life.period_ns * 1e-9)
        _warm(replay, life, first, resets_in(events))
        remembered = replay.remembered()
    records = _between(life, first, last)
    near = events[(events["tick"] >= first) & (events["tick"] <= last)]
    names = [d.name for d in in_force.interlocks.detectors] if known else None
    teller = _Teller(life, detectors, names, noticed.tick)
    before = records[records["tick"] == noticed.tick - 1]
    at = records[records["tick"] == noticed.tick]
    run_id = int(at["run"][0]) if len(at) else 0
    trips = teller.trips(near)
    expected = max(0, min(last, life.next_tick() - 1) - max(0, first) + 1)
    account = Account(
        loop_life=life.name,
        tick=noticed.tick,
        period_ns=life.period_ns,
        tripped_at=_when(life, noticed.tick),
        mode_before=Mode(int(before["mode"][0])).name.lower() if len(before) else None,
        run_id=run_id or None,
        run_tick=None if noticed.run_began is None else noticed.tick - noticed.run_began,
        first=next(t for t in trips if t.order == teller.order_of(near, noticed)),
        trips=trips,
        events=teller.events(near),
        peaks=_peaks(records, noticed.tick, life.period_ns),
        settings=Settings(
            controller=in_force.controller.model_dump(mode="json"),
            interlocks=in_force.interlocks.model_dump(mode="json") if known else None,
            rig=in_force.rig.model_dump(mode="json"),
            seed=in_force.seed,
        ),
        injected={Fault(kind).name.lower(): amount for kind, amount in noticed.injected.items()},
        lease=None if in_force.lease is None else dict(in_force.lease),
        steps=list(noticed.steps),
        began=noticed.began.name.lower(),
        remembered=remembered,
        first_tick=int(records["tick"][0]) if len(records) else -1,
        last_tick=int(records["tick"][-1]) if len(records) else -1,
        ticks=len(records),
        missing_ticks=expected - len(records),
    )
    return Box(account, records)


def _warm(replay: Replay, life: Life, first: int, resets: Sequence[int]) -> None:
    """Have the check see what came before the box, the box's first tick included."""
    since = first - round(REMEMBERED_S * 1e9 / life.period_ns)
    for at in range(since, first + 1, _TOGETHER):
        replay.take(_between(life, at, min(first, at + _TOGETHER - 1)), resets)


def _between(life: Life, first: int, last: int) -> Records:
    """The ticks from first to last, both included, that the ring holds."""
    reader = life.telemetry(life.position_of(first))
    records = reader.read(max(0, last - max(0, first) + 1)).records
    return records[(records["tick"] >= first) & (records["tick"] <= last)]


def _when(life: Life, tick: int) -> datetime:
    """The time of day of a tick, from the loop's last sign of life."""
    newest_ns = int(life.block.fields["loop_heartbeat_ns"])
    since_ns = (life.next_tick() - 1 - tick) * life.period_ns
    return datetime.now(UTC) - timedelta(microseconds=(monotonic_ns() - newest_ns + since_ns) / 1e3)


class _Teller:
    """Says events in words and in times from the first-out; `names` are those of the detectors, where known."""

    def __init__(
        self, life: Life, detectors: Records, names: Sequence[str] | None, tick: int
    ) -> None:
        self._period_ns = life.period_ns
        self._detectors = detectors
        self._names = names
        self._tick = tick

    def time_s(self, tick: int) -> float:
        return round((tick - self._tick) * self._period_ns * 1e-9, 9)

    def trips(self, events: Records) -> list[TripKept]:
        """What tripped, in order."""
        tripped = events[events["kind"] == EventKind.TRIP]
        return [self._trip(i, event) for i, event in enumerate(tripped)]

    def order_of(self, events: Records, noticed: Noticed) -> int:
        """The place of the first-out among the trips."""
        tripped = events[events["kind"] == EventKind.TRIP]
        return int(np.flatnonzero(tripped["sequence"] == noticed.event["sequence"])[0])

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


def _peaks(records: Records, tick: int, period_ns: int) -> list[PeakKept]:
    return peaks_of(records, tick, period_ns * 1e-9)


def peaks_of(records: Records, tick: int, period_s: float) -> list[PeakKept]:
    """The greatest magnitudes before a tick and from it on."""
    before, after = records[records["tick"] < tick], records[records["tick"] >= tick]
    found = []
    for name in PEAKS:
        value, _ = _peak(before, name)
        later, at = _peak(after, name)
        found.append(
            PeakKept(
                channel=name,
                unit=CHANNEL[name].unit,
                before=value,
                after=later,
                after_s=None if at is None else round((at - tick) * period_s, 9),
            )
        )
    return found


def _peak(records: Records, name: str) -> tuple[float | None, int | None]:
    """The value of the greatest magnitude, with its sign, and its tick."""
    sound = records[np.isfinite(records[name])]
    if not len(sound):
        return None, None
    at = int(np.argmax(np.abs(sound[name])))
    return float(sound[name][at]), int(sound["tick"][at])
