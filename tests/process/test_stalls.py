"""A loop under pressure that is stopped by SIGSTOP, or left by its app: what it does at its limits, for real."""

import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread
from typing import Any

import numpy as np
import pytest

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action, Comparison, Quantity
from rtcore.memory.commands import acknowledgement, post
from rtcore.memory.heartbeat import Beater
from rtcore.memory.rings import event_reader, telemetry_reader
from rtcore.memory.segment import Block, attach_block
from rtcore.modes import Mode
from tests.process.test_loop_process import Rack, stop, wait_for
from tests.unit.rtcore.programs import detector, gains, harmonic, interlocks, program

pytestmark = [pytest.mark.process, pytest.mark.slow]

PERIOD_S = 250e-6
LIMIT_S = 0.5
SILENCE, MISSED = 0, 1  # places in the table
MOST_MISSED = 200  # 50 ms: this machine has other work, too


class Loaded:
    """A loop process that plays 2 kN at 50 Hz, and an app that keeps its heartbeat."""

    def __init__(self, rack: Rack) -> None:
        self.process: subprocess.Popen[str] = rack.start()
        self.block: Block = attach_block(rack.path)
        self.beater = Beater()
        self.beater.turn_to(self.block)
        self._thread = Thread(target=self._beat, daemon=True)
        self._thread.start()
        above = {"comparison": Comparison.ABOVE}
        self.block.fields["gains"][1] = gains()
        self.block.fields["interlocks"][1] = interlocks(
            detector(Quantity.APP_SILENCE_S, LIMIT_S, Action.STOP, **above),
            detector(Quantity.DEADLINES_MISSED, MOST_MISSED, Action.STOP, **above),
        )
        self.block.fields["programs"][1] = program(harmonic(2000.0, 50.0, 100_000))
        for opcode in (Opcode.ADOPT_GAINS, Opcode.ADOPT_INTERLOCKS, Opcode.ADOPT_PROGRAM):
            self.ask(opcode, 1)
        self.ask(Opcode.RESET)
        self.ask(Opcode.PRESSURISE)
        wait_for(self.process, lambda: self.mode() == Mode.READY)
        self.ask(Opcode.START, 1)

    def _beat(self) -> None:
        shown = Thread(target=self.beater.keep_beating, daemon=True)
        shown.start()
        while not self.beater.has_ended():
            self.beater.show()
            time.sleep(0.05)

    def fall_silent(self) -> None:
        self.beater.end()
        self._thread.join()

    def mode(self) -> int:
        return int(self.block.fields["snapshot"]["mode"])

    def ask(self, opcode: Opcode, argument: int = 0) -> None:
        sequence = post(self.block, opcode, argument, time_to_live_s=30.0)
        wait_for(self.process, lambda: acknowledgement(self.block, sequence) is not None)
        answer = acknowledgement(self.block, sequence)
        assert answer is not None
        assert answer[0] == Reply.ACCEPTED, Reply(answer[0]).name

    def records(self) -> Any:
        return telemetry_reader(self.block).read(1 << 20).records

    def trips(self) -> list[Any]:
        return [e for e in event_reader(self.block).read().records if e["kind"] == EventKind.TRIP]


@pytest.fixture
def loaded() -> Iterator[Loaded]:
    with TemporaryDirectory(dir="/dev/shm", prefix="forcerig-test-") as folder:
        rack = Rack(Path(folder))
        try:
            made = Loaded(rack)
            yield made
            made.beater.end()
        finally:
            for process in rack.started:
                process.kill()
                process.communicate()


@pytest.mark.parametrize("stop_ms", [1, 10, 500])
def test_a_stalled_loop_latches_above_its_limit_and_not_below(loaded: Loaded, stop_ms: int) -> None:
    """The rule is the limit: whatever this machine adds to the stall, gaps and latch must agree."""
    stop(loaded.process)
    time.sleep(stop_ms * 1e-3)
    loaded.process.send_signal(signal.SIGCONT)
    published = int(loaded.block.fields["telemetry_published"])
    wait_for(
        loaded.process,
        lambda: int(loaded.block.fields["telemetry_published"]) > published + 4000,
    )
    records = loaded.records()
    under_pressure = records["mode"] >= Mode.PRESSURISING
    gaps = np.diff(records["deadlines_missed"], prepend=0) * under_pressure
    assert gaps.max() >= 4 * stop_ms - 2
    beyond = np.flatnonzero(gaps > MOST_MISSED)
    latched = np.flatnonzero(records["trips"] >> MISSED & 1)
    assert (len(beyond) > 0) == (len(latched) > 0)
    if stop_ms == 500:
        assert len(beyond) > 0
    if len(beyond) > 0:
        assert latched[0] == beyond[0], "in the very tick"
        assert records["mode"][latched[0]] == Mode.STOPPING
        wait_for(loaded.process, lambda: loaded.mode() == Mode.TRIPPED)
    assert (np.diff(records["tick"]) == 1).all()


def test_the_heartbeat_is_missed_one_tick_after_its_limit(loaded: Loaded) -> None:
    """As far as the loop was awake: how late it was in that tick is in its record."""
    loaded.fall_silent()
    wait_for(loaded.process, lambda: loaded.mode() == Mode.TRIPPED)
    trip = next(e for e in loaded.trips() if e["code"] == SILENCE)
    records = loaded.records()
    at = int(np.flatnonzero(records["tick"] == trip["tick"])[0])
    late_s = float(records["wakeup_latency_s"][at])
    print(f"silent for {trip['value']:.6f} s at the trip, limit {LIMIT_S} s, {late_s:.6f} s late")
    assert LIMIT_S < trip["value"] <= LIMIT_S + PERIOD_S + late_s
    assert records["mode"][at] == Mode.STOPPING
    assert records["mode"][at - 1] == Mode.RUNNING
