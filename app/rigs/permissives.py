"""What has to be so for a test to start: each a lamp with a sentence that says what it needs."""

from dataclasses import dataclass

from app.link.words import QUANTITIES
from app.rigs.reasons import LOST, READY_PA
from app.rigs.schemas import Permissive
from rtcore.interlocks import Quantity
from rtcore.modes import Mode, is_closed_loop, is_run


@dataclass(frozen=True)
class Readiness:
    """What the permissives depend on. `mode` is None without a loop; `trip` is what tripped first.

    `recorder_follows` is whether the recorder has caught up with this life of the loop.
    """

    mode: Mode | None
    trip: str | None
    supply_pressure_pa: float
    recorder_follows: bool
    recorder_trouble: str | None
    disk_is_full: bool


def permissives(now: Readiness) -> list[Permissive]:
    """All of them, in the order in which an operator brings them about."""
    rows = (
        ("loop", now.mode is not None, "The loop process runs", f"{LOST}: wait until it is back"),
        ("interlocks", *_interlocks(now)),
        ("pressure", *_pressure(now)),
        ("recorder", *_recorder(now)),
        ("storage", not now.disk_is_full, "There is room on the disk", _FULL),
        ("idle", *_idle(now)),
    )
    return [
        Permissive(name=name, met=met, text=so if met else lacking)
        for name, met, so, lacking in rows
    ]


_FULL = "The disk is full: remove samples of old runs"
_Row = tuple[bool, str, str]


def _interlocks(now: Readiness) -> _Row:
    met = now.trip is None and now.mode not in (None, Mode.TRIPPED)
    because = now.trip or "the rig starts latched"
    lacking = LOST if now.mode is None else f"Press Reset: {because}"
    return met, "No interlock is tripped", lacking


def _pressure(now: Readiness) -> _Row:
    write = QUANTITIES[Quantity.SUPPLY_PRESSURE_PA].write
    has, needs = write(now.supply_pressure_pa), write(READY_PA)
    how = "wait" if now.mode is Mode.PRESSURISING else "press Pressurise"
    met = now.mode is not None and bool(is_closed_loop(now.mode))
    lacking = LOST if now.mode is None else f"Supply pressure {has}, {needs} needed: {how}"
    return met, f"Supply pressure {has}", lacking


def _recorder(now: Readiness) -> _Row:
    reading = "The recorder is still reading what happened before: wait"
    met = now.recorder_follows and now.recorder_trouble is None
    return met, "The recorder is ready", now.recorder_trouble or reading


def _idle(now: Readiness) -> _Row:
    met = now.mode is None or not is_run(now.mode)
    return met, "No test is running", "A test is running: wait for its end, or stop it"
