"""A loop that does what a test says: it writes a private block through the very kernels of the loop."""

from typing import Any

import numpy as np

from app.link.life import Life
from rtcore.channels import TELEMETRY
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action, Comparison, Quantity
from rtcore.memory.rings import publish_event, publish_record
from rtcore.memory.segment import private_block
from rtcore.memory.snapshot import write_snapshot
from rtcore.modes import Mode

PERIOD_NS = 250_000
PERIOD_S = PERIOD_NS * 1e-9
FORCE_ERROR, APP_SILENCE, FORCE_HINT = 0, 1, 2  # places in its table of detectors
_DETECTORS = (
    (Quantity.FORCE_ERROR_N, Comparison.MAGNITUDE_ABOVE, Action.STOP, 200, 6000.0),
    (Quantity.APP_SILENCE_S, Comparison.ABOVE, Action.STOP, 1, 0.5),
    (Quantity.FORCE_N, Comparison.MAGNITUDE_ABOVE, Action.INDICATE, 1, 1000.0),
    (Quantity.VELOCITY_M_S, Comparison.BELOW, Action.INDICATE, 1, -0.3),
)


class WrittenBlock:
    """Ticks, events and changes of mode, one after another. Its force is the number of the tick."""

    def __init__(self, ring_seconds: float = 2.0) -> None:
        self.block = private_block(PERIOD_NS, ring_seconds)
        self.block.fields["loop_started_ns"] = 1
        self.block.fields["loop_pid"] = 42
        self.tick = 0
        self.mode = Mode.TRIPPED
        table = self.block.fields["interlocks"][0]
        table["count"] = len(_DETECTORS)
        for i, (quantity, comparison, action, ticks, threshold) in enumerate(_DETECTORS):
            detector = table["detectors"][i]
            detector["quantity"], detector["comparison"], detector["action"] = (
                quantity,
                comparison,
                action,
            )
            detector["persistence_ticks"], detector["threshold"] = ticks, threshold
            detector["enabled"], detector["latching"], detector["armed_modes"] = 1, 1, -1

    def life(self) -> Life:
        """A fresh view of it, as of an app that has just started."""
        return Life(self.block)

    def ticks(self, count: int, run: int = 0, **values: Any) -> None:
        """Publish so many ticks; `values` are of other channels."""
        for _ in range(count):
            record = np.zeros((), TELEMETRY)
            record["tick"], record["run"], record["mode"] = self.tick, run, self.mode
            record["time_s"], record["force_n"] = self.tick * PERIOD_S, self.tick
            for name, value in values.items():
                record[name] = value
            slot = self.tick & (len(self.block.ring) - 1)
            self.block.ring[slot] = record
            write_snapshot(self.block.address, self.block.ring[slot : slot + 1].ctypes.data)
            publish_record(self.block.address)
            self.tick += 1

    def report(self, kind: EventKind, code: int, value: float = 0.0, limit: float = 0.0) -> None:
        """Publish an event of the tick that comes next."""
        publish_event(self.block.address, self.tick, int(kind), int(code), value, limit)

    def obey(self, opcode: Opcode, reply: Reply = Reply.ACCEPTED) -> None:
        """Report that a command was taken."""
        self.report(EventKind.COMMAND, opcode, float(reply))

    def go(self, mode: Mode) -> None:
        """Change the mode, from the next tick on."""
        self.report(EventKind.MODE, mode, float(self.mode))
        self.mode = mode

    def trip(self, detector: int, value: float, limit: float) -> None:
        """Report that a detector tripped."""
        self.report(EventKind.TRIP, detector, value, limit)

    def whole_run(self, run: int, ticks: int) -> None:
        """A run from its start to its end, with some ticks on both sides that are of no run."""
        self.ticks(10)
        self.begin(run)
        self.ticks(ticks - 5, run)
        self.report(EventKind.PROGRAM_ENDED, run)
        self.go(Mode.STOPPING)
        self.ticks(5, run)
        self.go(Mode.READY)
        self.ticks(10)

    def begin(self, run: int) -> None:
        """A run starts with the next tick."""
        self.report(EventKind.MODE, Mode.RUNNING, float(self.mode))
        self.mode = Mode.RUNNING
        self.report(EventKind.COMMAND, Opcode.START, float(Reply.ACCEPTED), float(run))
