"""Scores a drill from what the loop recorded and reported: a pure function over ticks and events."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from app.drills.drills import Drill, Reaction
from app.drills.score import Expectation, Peak, Score
from rtcore.channels import CHANNEL
from rtcore.codes import EventKind
from rtcore.interlocks import Action
from rtcore.modes import Mode
from rtcore.rig.faults import Fault
from rtcore.rig.parameters import RigParameters

Records = npt.NDArray[Any]

SAFE_S = 1.0  # within which a controlled stop must have ended in a trip
BLED_S = 1.5  # within which the supply must be bled, then
BLED_PA = 1e6
LEAD_S, TAIL_S = 0.5, 0.25  # of samples before the fault, and after everything has been seen
_LOAD_CELL = (
    *(Fault.LOAD_CELL_OPEN, Fault.LOAD_CELL_FROZEN, Fault.LOAD_CELL_SIGN, Fault.LOAD_CELL_NOISE),
    *(Fault.LOAD_CELL_NAN, Fault.LOAD_CELL_DRIFT),
)


@dataclass(frozen=True)
class Limits:
    """What no fault may drive the rig beyond."""

    force_n: float
    displacement_m: float
    area_m2: float  # of the piston: the chambers tell the force where the load cell does not

    @staticmethod
    def of(rig: RigParameters) -> "Limits":
        """The end of the load cell's range, and the end of the unit's stroke."""
        return Limits(rig.sensors.force_range_n, rig.unit.stroke_m, rig.load_actuator.area_m2)


@dataclass(frozen=True)
class Seen:
    """A drill as it was recorded: (n,) TELEMETRY and EVENT from the fault's tick on, and the table in force."""

    tick: int  # in which the loop took the fault
    mode: Mode  # the rig's just before
    period_s: float
    records: Records
    events: Records
    detectors: Records
    names: Sequence[str]  # of the detectors

    def first_out(self) -> tuple[int, int] | None:
        """(tick, place in the table) of what took the load off; None where nothing did."""
        trips = self.events[self.events["kind"] == EventKind.TRIP]
        found = [(int(e["tick"]), int(e["code"])) for e in trips]
        acting = [(t, place) for t, place in found if self.action(place) >= Action.STOP]
        # Of several in one tick the strongest action, then the table's order.
        return min(acting, key=lambda f: (f[0], -self.action(f[1]), f[1]), default=None)

    def action(self, place: int) -> Action:
        """What the detector at a place of the table does."""
        return Action(int(self.detectors[place]["action"]))

    def tripped(self) -> int | None:
        """The first tick in which the rig was tripped: valve at null, supply off."""
        modes = self.events[self.events["kind"] == EventKind.MODE]
        found = modes["tick"][modes["code"] == Mode.TRIPPED]
        return int(found[0]) if len(found) else None


def reaction_of(drill: Drill, mode: Mode) -> Reaction | None:
    """What must follow where the rig is in this mode; None where the drill cannot be given then."""
    if mode is Mode.READY:
        return drill.ready
    return drill.test if mode in (Mode.RUNNING, Mode.HOLDING) else None


def is_over(reaction: Reaction, seen: Seen, newest: int) -> bool:
    """Whether everything has been seen by the tick `newest`, or too much time has gone by."""
    ticks = newest - seen.tick
    tripped = seen.tripped()
    if tripped is not None:
        return newest - tripped >= round((BLED_S + TAIL_S) / seen.period_s)
    first = seen.first_out()
    if first is not None:
        return newest - first[0] >= round((SAFE_S + TAIL_S) / seen.period_s)
    return ticks >= round((reaction.within_s + TAIL_S) / seen.period_s)


def score(drill: Drill, reaction: Reaction, seen: Seen, limits: Limits) -> Score:
    """What came of it, against what must have."""
    after = seen.records[seen.records["tick"] > seen.tick]
    first, tripped = seen.first_out(), seen.tripped()
    peaks = list(_peaks(drill.fault, seen, after, limits))
    expected = _left_alone(seen) if not reaction.first_outs else _reacted(reaction, seen)
    return Score(
        first_out=None if first is None else seen.names[first[1]],
        action=None if first is None else seen.action(first[1]).name.lower(),
        reaction_ticks=None if first is None else first[0] - seen.tick,
        safe_ticks=None if tripped is None else tripped - seen.tick,
        mode_after=Mode(int(seen.records["mode"][-1])).name.lower(),
        peaks=peaks,
        expectations=[*expected, *(_within(p) for p in peaks if p.limit is not None)],
    )


def _left_alone(seen: Seen) -> Iterator[Expectation]:
    first = seen.first_out()
    if first is None:
        yield Expectation(name="load_stays", met=True, text="Nothing took the load off")
    else:
        text = f"{seen.names[first[1]]} took the load off, and had no reason to"
        yield Expectation(name="load_stays", met=False, text=text)


def _reacted(reaction: Reaction, seen: Seen) -> Iterator[Expectation]:
    first = seen.first_out()
    if first is None:
        text = f"Nothing took the load off within {reaction.within_s:g} s"
        yield Expectation(name="first_out", met=False, text=text)
        return
    name, took_s = seen.names[first[1]], (first[0] - seen.tick) * seen.period_s
    known = name in reaction.first_outs
    text = f"{name} was the first-out" + ("" if known else _instead_of(reaction.first_outs))
    yield Expectation(name="first_out", met=known, text=text)
    text = f"The rig knew after {_ms(took_s)}; {_ms(reaction.within_s)} are allowed"
    yield Expectation(name="in_time", met=took_s <= reaction.within_s + 1e-9, text=text)
    yield from _made_safe(first[0], seen)


def _instead_of(names: Sequence[str]) -> str:
    return f", where it must be {' or '.join(names)}"


def _made_safe(first: int, seen: Seen) -> Iterator[Expectation]:
    """The load taken off, in a controlled way or at once, and the rig latched without pressure."""
    tripped = seen.tripped()
    took_s = None if tripped is None else (tripped - first) * seen.period_s
    if tripped is None or took_s is None:
        text = f"The rig did not trip within {SAFE_S:g} s of its first-out"
        yield Expectation(name="tripped", met=False, text=text)
        return
    when = "in the same tick" if tripped == first else f"{_ms(took_s)} later"
    yield Expectation(name="tripped", met=took_s <= SAFE_S, text=f"The rig tripped {when}")
    rest = seen.records[seen.records["tick"] >= tripped]
    safe = bool(np.all(rest["mode"] == Mode.TRIPPED) and np.all(rest["valve_command"] == 0.0))
    text = "Valve at null and latched from then on" if safe else "The valve was commanded again"
    yield Expectation(name="valve_null", met=safe, text=text)
    bled_pa = float(rest["supply_pressure_pa"][-1])
    text = (
        f"Supply pressure {bled_pa * 1e-5:.1f} bar at the end; {BLED_PA * 1e-5:g} bar are allowed"
    )
    yield Expectation(name="supply_off", met=bled_pa <= BLED_PA, text=text)


def _ms(seconds: float) -> str:
    return f"{seconds * 1e3:.4g} ms" if seconds < 1.0 else f"{seconds:.3g} s"


def _peaks(fault: Fault, seen: Seen, after: Records, limits: Limits) -> Iterator[Peak]:
    force_n = after["force_n"].astype(np.float64)
    if fault in _LOAD_CELL:  # what it says is not what pushes
        force_n = limits.area_m2 * (after["pressure_1_pa"] - after["pressure_2_pa"])
    columns = (
        ("force_n", force_n, limits.force_n, True),
        ("displacement_m", after["displacement_m"], limits.displacement_m, fault is not Fault.LVDT_OPEN),
        ("velocity_m_s", after["velocity_m_s"], None, fault is not Fault.LVT_FROZEN),
    )  # fmt: skip
    for name, values, limit, sound in columns:
        at = int(np.argmax(np.abs(values))) if sound and np.all(np.isfinite(values)) else None
        yield Peak(
            channel=name,
            unit=CHANNEL[name].unit,
            value=None if at is None else float(values[at]),
            limit=limit,
            after_s=None if at is None else (int(after["tick"][at]) - seen.tick) * seen.period_s,
        )


def _within(peak: Peak) -> Expectation:
    name, spoken = f"{peak.channel}_within", peak.channel.rpartition("_")[0].replace("_", " ")
    assert peak.limit is not None
    if peak.value is None:
        text = f"The {spoken} cannot be judged: its own sensor is what is broken"
        return Expectation(name=name, met=True, text=text)
    scale, unit = (1e-3, "kN") if peak.unit == "N" else (1e3, "mm")
    text = (
        f"At most {abs(peak.value) * scale:.1f} {unit}; {peak.limit * scale:g} {unit} are allowed"
    )
    return Expectation(name=name, met=abs(peak.value) <= peak.limit, text=text)
