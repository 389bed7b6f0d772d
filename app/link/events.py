"""What the loop reports, in words."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from app.link.life import Life, RingReader
from app.link.words import trip_code, trip_text
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action
from rtcore.modes import Mode
from rtcore.rig.faults import Fault


@dataclass(frozen=True)
class LoopEvent:
    """One event of the loop. `sequence` counts from the start of this life of the loop."""

    sequence: int
    tick: int
    time_s: float
    kind: str
    code: str
    text: str
    value: float
    limit: float
    ends_run: bool = False  # a detector or the program itself took the load off
    detector: int = -1  # of a trip: its place in the table

    def is_mode(self, mode: Mode) -> bool:
        """Whether the loop went into this mode."""
        return self.kind == "mode" and self.code == mode.name.lower()

    def is_accepted(self, opcode: Opcode) -> bool:
        """Whether the loop obeyed this command."""
        return self.kind == "command" and self.code == opcode.name.lower()


class EventReader:
    """Reads the events of one life of the loop, as words."""

    def __init__(self, life: Life) -> None:
        self._life = life
        self._ring: RingReader = life.events()

    def skip(self) -> None:
        """Leave out what has been reported until now."""
        self._ring.position = self._ring.published

    def read(self) -> list[LoopEvent]:
        """What has been reported since the last call."""
        records = self._ring.read().records
        if len(records) == 0:
            return []
        detectors = self._life.detectors()
        return [describe(record, detectors, self._life.period_ns) for record in records]


def describe(record: Any, detectors: npt.NDArray[Any], period_ns: int) -> LoopEvent:
    """An EVENT record in words."""
    kind, code, text = _words(record, detectors, period_ns)
    stops = kind == "trip" and _action(detectors, int(record["code"])) >= Action.STOP
    return LoopEvent(
        sequence=int(record["sequence"]),
        tick=int(record["tick"]),
        time_s=int(record["tick"]) * period_ns / 1e9,
        kind=kind,
        code=code,
        text=text,
        value=float(record["value"]),
        limit=float(record["limit"]),
        ends_run=stops or kind == "program_fault",
        detector=int(record["code"]) if kind == "trip" else -1,
    )


def _action(detectors: npt.NDArray[Any], index: int) -> int:
    return int(detectors[index]["action"]) if index < len(detectors) else Action.STOP


_Words = tuple[str, str, str]  # kind, code and text


def _words(record: Any, detectors: npt.NDArray[Any], period_ns: int) -> _Words:
    kind, code = EventKind(int(record["kind"])), int(record["code"])
    value, limit = float(record["value"]), float(record["limit"])
    if kind is EventKind.TRIP:
        return _trip_words(code, value, limit, detectors, period_ns)
    if kind is EventKind.CLEARED:
        name = _detector_name(code, detectors)
        return "cleared", name, f"{_spoken(name)} is content again"
    if kind is EventKind.SKIPPED:
        text = f"Went on with the frequency response {value * period_ns * 1e-9:.1f} s early"
        return "skipped", str(code), text
    return _WORDS[kind](code, value)


def _spoken(name: str) -> str:
    return name.replace("_", " ").capitalize()


def _detector_name(index: int, detectors: npt.NDArray[Any]) -> str:
    return trip_code(detectors[index]) if index < len(detectors) else f"detector_{index}"


def _trip_words(
    index: int, value: float, limit: float, detectors: npt.NDArray[Any], period_ns: int
) -> _Words:
    name = _detector_name(index, detectors)
    if index >= len(detectors):
        return "trip", name, f"Detector {index} tripped"
    return "trip", name, trip_text(detectors[index], value, limit, period_ns)


def _mode_words(code: int, _: float) -> _Words:
    name = Mode(code).name.lower()
    return "mode", name, name.capitalize()


def _block_words(code: int, _: float) -> _Words:
    return "block", str(code), f"Block {code + 1}" if code >= 0 else "Between blocks"


def _program_fault_words(astray: int, _: float) -> _Words:
    if astray:
        return "program_fault", "astray", "The test led beyond the limits"
    return "program_fault", "starved", "The test did not reach the loop in time"


def _missed_words(missed: int, latest_ns: float) -> _Words:
    deadlines = "1 deadline" if missed == 1 else f"{missed} deadlines"
    text = f"{deadlines} missed, up to {latest_ns * 1e-6:.1f} ms late"
    return "deadlines_missed", "deadlines_missed", text


def _fault_words(kind: int, amount: float) -> _Words:
    name = Fault(kind).name.lower() if kind in list(Fault) else f"fault_{kind}"
    done = f"injected, {amount:g}" if amount else "taken away"
    return "fault", name, f"{_spoken(name)} {done}"


def _stop_words(stopped: int, _: float) -> _Words:
    return "stop_asked", "stop_asked", "Stop" if stopped else "Stop, with nothing to stop"


def _command_words(code: int, value: float) -> _Words:
    reply, name = Reply(int(value)), Opcode(code).name.lower()
    if reply is Reply.ACCEPTED:
        return "command", name, _spoken(name)
    return "refusal", name, f"{_spoken(name)} refused: {reply.name.lower().replace('_', ' ')}"


_WORDS: Mapping[EventKind, Callable[[int, float], _Words]] = {
    EventKind.MODE: _mode_words,
    EventKind.COMMAND: _command_words,
    EventKind.BLOCK: _block_words,
    EventKind.PROGRAM_ENDED: lambda *_: (
        *("program_ended", "program_ended"),
        "The test has run to its end",
    ),
    EventKind.PROGRAM_FAULT: _program_fault_words,
    EventKind.DEADLINES_MISSED: _missed_words,
    EventKind.LEASE: lambda code, _: ("lease", str(code), f"Command has passed to lease {code}"),
    EventKind.FAULT: _fault_words,
    EventKind.STOP_ASKED: _stop_words,
}
