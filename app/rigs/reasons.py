"""Why a command cannot be given now: a table of modes and commands, in words that say what to do."""

from collections.abc import Mapping
from dataclasses import dataclass

from app.link.words import QUANTITIES
from app.rigs.schemas import CommandReasons
from rtcore.core import make_core
from rtcore.interlocks import Quantity
from rtcore.modes import Mode

READY_PA = float(make_core(250e-6, {})["settings"]["ready_pa"][0])
LOST = "The loop process does not run"
_LATCHED = "Press Reset first: {trip}"
_PRESSURE = "Cannot start: supply pressure {pressure}, {needed} needed"
_TEST_RUNS = "Stop the test first"


@dataclass(frozen=True)
class Situation:
    """What the reasons depend on. `trip` is what tripped first, None where nothing is latched."""

    mode: Mode | None  # None: no loop
    trip: str | None
    supply_pressure_pa: float


Row = Mapping[str, str]
_ALWAYS: Row = {
    "pressurise": "Already pressurised",
    "depressurise": _TEST_RUNS,
    "tare": "Depressurise first: only an unloaded load cell can be tared",
    "start": "A test is running",
    "hold": "Nothing is running",
    "resume": "Nothing is held",
}
_UNPRESSURISED: Row = {"depressurise": "Already depressurised", "tare": "", "start": _PRESSURE}
_TABLE: Mapping[Mode, Row] = {
    Mode.TRIPPED: {
        **_UNPRESSURISED,
        "tare": _LATCHED,
        "pressurise": _LATCHED,
        "start": _LATCHED,
    },
    Mode.OFF: {**_UNPRESSURISED, "pressurise": "", "start": f"{_PRESSURE}: press Pressurise"},
    Mode.PRESSURISING: {
        "pressurise": "Already pressurising",
        "depressurise": "",
        "start": _PRESSURE,
    },
    Mode.READY: {"depressurise": "", "start": ""},
    Mode.RUNNING: {"hold": ""},
    Mode.HOLDING: {"hold": "Already held", "resume": ""},
    Mode.STOPPING: {},
}


def reasons(now: Situation) -> CommandReasons:
    """Of each command why it cannot be given, None where it can."""
    if now.mode is None:
        return CommandReasons(**dict.fromkeys(CommandReasons.model_fields, LOST))
    table = {**_ALWAYS, **_TABLE[now.mode]}
    if now.trip is not None:
        table |= {name: _LATCHED for name in ("pressurise", "start", "resume") if not table[name]}
    table |= {"stop": "", "shutdown": "", "reset": "" if _resettable(now) else "Nothing is tripped"}
    return CommandReasons(**{name: _filled(text, now) for name, text in table.items()})


def _resettable(now: Situation) -> bool:
    return now.mode is Mode.TRIPPED or now.trip is not None


def _filled(text: str, now: Situation) -> str | None:
    write = QUANTITIES[Quantity.SUPPLY_PRESSURE_PA].write
    trip = now.trip or "the rig starts latched"
    pressure, needed = write(now.supply_pressure_pa), write(READY_PA)
    return text.format(trip=trip, pressure=pressure, needed=needed) or None
