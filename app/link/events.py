"""What the loop reports, in words."""

from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from app.link.life import Life, RingReader
from app.link.words import trip_code, trip_text
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action
from rtcore.modes import Mode


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


def _words(record: Any, detectors: npt.NDArray[Any], period_ns: int) -> tuple[str, str, str]:
    """Kind, code and text of an event."""
    kind, code = EventKind(int(record["kind"])), int(record["code"])
    value, limit = float(record["value"]), float(record["limit"])
    match kind:
        case EventKind.MODE:
            name = Mode(code).name.lower()
            return "mode", name, name.capitalize()
        case EventKind.TRIP:
            if code >= len(detectors):
                return "trip", f"detector_{code}", f"Detector {code} tripped"
            detector = detectors[code]
            return "trip", trip_code(detector), trip_text(detector, value, limit, period_ns)
        case EventKind.COMMAND:
            return _command_words(Opcode(code), Reply(int(value)))
        case EventKind.BLOCK:
            return "block", str(code), f"Block {code + 1}" if code >= 0 else "Between blocks"
        case EventKind.PROGRAM_ENDED:
            return "program_ended", "program_ended", "The test has run to its end"
        case EventKind.PROGRAM_FAULT:
            astray, starved = (
                "The test led beyond the limits",
                "The test did not reach the loop in time",
            )
            text = astray if code else starved
            return "program_fault", "astray" if code else "starved", text
        case EventKind.DEADLINES_MISSED:
            deadlines = "1 deadline" if code == 1 else f"{code} deadlines"
            text = f"{deadlines} missed, up to {value * 1e-6:.1f} ms late"
            return "deadlines_missed", "deadlines_missed", text


def _command_words(opcode: Opcode, reply: Reply) -> tuple[str, str, str]:
    name = opcode.name.lower()
    spoken = name.replace("_", " ").capitalize()
    if reply is Reply.ACCEPTED:
        return "command", name, spoken
    return "refusal", name, f"{spoken} refused: {reply.name.lower().replace('_', ' ')}"
