"""One life of the loop process, as the app sees it: its block, its signs of life, its rings."""

import json
from dataclasses import dataclass, field
from time import monotonic_ns
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.memory.playing import read_playing
from rtcore.memory.rings import Batch, RingReader, event_reader, telemetry_reader
from rtcore.memory.segment import Block
from rtcore.memory.snapshot import read_snapshot
from rtcore.modes import Mode
from rtcore.rig.faults import Fault

__all__ = ["SILENT_S", "Batch", "Life", "RingReader"]

SILENT_S = 0.5  # a loop that has not beaten for so long counts as lost: well within a second


@dataclass(eq=False)
class Life:
    """A block and the loop that writes it. Once `ended` is true nothing is ever published in it."""

    block: Block
    ended: bool = False
    configured: bool = field(default=False)  # whether it has this app's gains and interlocks

    @property
    def name(self) -> str:
        """Names this life among all lives of the loop since the machine was started."""
        return f"{int(self.block.fields['loop_started_ns'])}-{self.pid}"

    @property
    def pid(self) -> int:
        return int(self.block.fields["loop_pid"])

    @property
    def period_ns(self) -> int:
        return int(self.block.fields["period_ns"])

    @property
    def beaten(self) -> bool:
        """Whether the loop has shown any sign of life in this block."""
        return int(self.block.fields["loop_heartbeat_ns"]) > 0

    def age_s(self) -> float:
        """Time since the loop's last sign of life."""
        return max(0, monotonic_ns() - int(self.block.fields["loop_heartbeat_ns"])) * 1e-9

    @property
    def alive(self) -> bool:
        """Whether the loop has beaten lately."""
        return not self.ended and self.beaten and self.age_s() < SILENT_S

    def snapshot(self) -> Any | None:
        """The latest telemetry record, a scalar of `TELEMETRY`, or None where there is none."""
        if int(self.block.fields["telemetry_published"]) == 0:
            return None
        return read_snapshot(self.block)

    def mode(self) -> Mode | None:
        """The mode of the latest tick."""
        record = self.snapshot()
        return None if record is None else Mode(int(record["mode"]))

    @property
    def lease(self) -> int:
        """The epoch that the loop obeys."""
        return int(self.block.fields["lease"])

    def injected(self) -> dict[Fault, float]:
        """The faults that the simulated rig has now, with their amounts."""
        amounts = self.block.fields["injected"]
        return {fault: float(amounts[fault]) for fault in Fault if amounts[fault] != 0.0}

    def has_recorded(self, position: int) -> None:
        """Tell the loop that the records before this one are safe on a disk."""
        self.block.fields["recorded"] = position

    def conditions(self) -> list[dict[str, Any]]:
        """Which real-time conditions the loop had: name, had, reason."""
        conditions: list[dict[str, Any]] = json.loads(self.block.fields["conditions"] or b"[]")
        return conditions

    def telemetry(self, position: int = 0) -> RingReader:
        """A reader of every tick, from the ring's record number `position` on."""
        return telemetry_reader(self.block, position)

    def events(self, position: int = 0) -> RingReader:
        """A reader of the events, as far back as the ring holds them."""
        return event_reader(self.block, position)

    def playing(self) -> tuple[npt.NDArray[Any], npt.NDArray[Any]] | None:
        """(2,) GENERATOR of force and motion, and the (1,) PROGRAM that they play; None where torn."""
        states = read_playing(self.block)
        bank = int(self.block.fields["active_program"])
        return (
            None
            if states is None
            else (states, self.block.fields["programs"][bank : bank + 1].copy())
        )

    def detectors(self) -> npt.NDArray[Any]:
        """The interlock table in force, (count,) of `DETECTOR`."""
        table = self.block.fields["interlocks"][int(self.block.fields["active_interlocks"])]
        return np.array(table["detectors"][: int(table["count"])])

    def gains(self) -> Any:
        """The gains in force, () of `GAINS`."""
        return self.block.fields["gains"][int(self.block.fields["active_gains"])].copy()

    def model(self) -> Any:
        """The model of the rig that the twin is of, () of `MODEL`; zeros until one is adopted."""
        return self.block.fields["models"][int(self.block.fields["active_model"])].copy()

    def next_tick(self) -> int:
        """The tick that is published next, or later."""
        reader = self.telemetry()
        reader.position = max(0, reader.published - 1)
        newest = reader.read().records
        return int(newest[-1]["tick"]) + 1 if len(newest) else 0

    def position_of(self, tick: int) -> int:
        """The record number of a tick in the telemetry ring: the first tick of a life is 0."""
        return max(0, tick)
