"""The black box: every tick of all channels around a first-out, copied out of the ring."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from time import monotonic_ns
from typing import Any

import numpy as np
import numpy.typing as npt

from app.controller.settings import ControllerSettings
from app.first_outs.account import Account, Settings
from app.first_outs.noticing import Noticed, resets_in
from app.first_outs.peaks import peaks_of
from app.first_outs.telling import Teller
from app.interlocks.record import to_record
from app.interlocks.table import Interlocks
from app.link.life import Life
from rtcore.modes import Mode
from rtcore.replay import Replay
from rtcore.rig.faults import Fault
from rtcore.rig.parameters import RigParameters

Records = npt.NDArray[Any]

AROUND_S = 2.0  # before and after
REMEMBERED_S = 20.0  # before the box, that the loop's check may remember something of
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
    teller = Teller(life.period_ns, detectors, names, noticed.tick)
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
        first=next(t for t in trips if t.order == teller.order_of(near, noticed.event)),
        trips=trips,
        events=teller.events(near),
        peaks=peaks_of(records, noticed.tick, life.period_ns * 1e-9),
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
