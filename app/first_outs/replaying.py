"""The detectors over a black box once more, by the loop's own check: as they were, and with values changed."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from app.errors import Code, Fault, Refusal
from app.first_outs.account import Account, TripKept
from app.first_outs.changes import Changed, InForceThen, change_detectors, settings_then
from app.first_outs.files import BoxSamples
from app.first_outs.replay_schemas import NotReplayed, ReplayOut, ValueChanged
from app.first_outs.telling import Teller
from app.first_outs.words import first_out_among, replayed_text
from app.interlocks.record import to_record
from rtcore.channels import CHANNELS, TELEMETRY
from rtcore.interlocks import Quantity
from rtcore.replay import NOT_RECORDED, Replay

Records = npt.NDArray[Any]


def records_of(samples: BoxSamples) -> Records:
    """Every tick of a black box, (n,) TELEMETRY."""
    names = [c.name for c in CHANNELS]
    parts = []
    for columns in samples.chunks(names, samples.first_tick, samples.last_tick):
        part = np.zeros(len(columns["tick"]), TELEMETRY)
        for name in names:
            part[name] = columns[name]
        parts.append(part)
    return np.concatenate(parts)


def replay(
    account: Account, samples: BoxSamples, changes: Mapping[str, Any]
) -> ReplayOut | Refusal:
    """Which detectors trip over the recorded ticks, as they were and with these values changed.

    Valid up to where the recorded rig was stopped: from there on the samples are those of a rig that stops.
    """
    then = settings_then(account.settings)
    if isinstance(then, Refusal):
        return then
    found = change_detectors(then, changes)
    if isinstance(found, Refusal):
        return found
    changed, made = found
    refusal = _not_to_be_replayed(then, made)
    if refusal is not None:
        return refusal
    records = records_of(samples)
    recorded = account.trips
    as_it_was = _trips(account, then, records, set())
    differing = {name for name, *_ in (_split(c.path) for c in made)}
    as_changed = _trips(account, changed, records, differing) if made else as_it_was
    left_out = {d.name for d in then.interlocks.detectors if d.quantity in NOT_RECORDED}
    reproduces = _told(as_it_was) == _told(t for t in recorded if t.detector not in left_out)
    kept = [trip for trip in recorded if trip.detector in left_out]
    first = first_out_among([*as_changed, *kept], _order(changed))
    return ReplayOut(
        recorded=recorded,
        unchanged=as_it_was,
        changed=as_changed,
        first_out=first,
        reproduces=reproduces,
        changes=[ValueChanged(path=c.path, before=c.before, value=c.value) for c in made],
        not_replayed=[
            _left_out(d.name, d.quantity) for d in then.interlocks.detectors if d.name in left_out
        ],
        text=replayed_text(account.first, first, made, reproduces=reproduces),
    )


def _trips(
    account: Account, then: InForceThen, records: Records, differing: set[str]
) -> list[TripKept]:
    period_s = account.period_ns * 1e-9
    table = to_record(then.interlocks, period_s)
    again = Replay(table, then.rig, then.controller.valve_limit, period_s)
    again.recall(account.remembered)
    names = [d.name for d in then.interlocks.detectors]
    for name in differing:
        again.forget(names.index(name))
    resets = [e.tick for e in account.events if (e.kind, e.code) == ("command", "reset")]
    events = again.take(records, resets)
    detectors = table["detectors"][: int(table["count"])]
    return Teller(account.period_ns, detectors, names, account.tick).trips(events)


def _not_to_be_replayed(then: InForceThen, made: Sequence[Changed]) -> Refusal | None:
    quantities = {d.name: d.quantity for d in then.interlocks.detectors}
    faults = []
    for one in made:
        name, _ = _split(one.path)
        quantity = quantities[name]
        if quantity in NOT_RECORDED:
            text = f"{name} cannot be replayed: {NOT_RECORDED[quantity]} is not in the recording"
            faults.append(Fault(f"interlocks.{name}", one.value, text))
    if not faults:
        return None
    return Refusal(Code.INVALID_REQUEST, "; ".join(f.expected for f in faults), tuple(faults))


def _split(path: str) -> tuple[str, str]:
    """Detector and key of `interlocks.force_error.threshold`."""
    name, _, key = path.removeprefix("interlocks.").partition(".")
    return name, key


def _told(trips: Iterable[TripKept]) -> list[tuple[int, str]]:
    return sorted((trip.tick, trip.detector) for trip in trips)


def _order(then: InForceThen) -> list[str]:
    return [d.name for d in then.interlocks.detectors]


def _left_out(name: str, quantity: Quantity) -> NotReplayed:
    return NotReplayed(detector=name, why=f"{NOT_RECORDED[quantity]} is not in the recording")
