"""The loop process on its own: started, stopped, signalled, killed and refused, for real."""

import ctypes
import json
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rtcore.memory.rings import telemetry_reader
from rtcore.memory.segment import Block, attach_block, loop_is_running
from rtcore.modes import Mode

pytestmark = [pytest.mark.process, pytest.mark.slow]

PERIOD_NS = 250_000
PERIOD_S = PERIOD_NS * 1e-9
START_LIMIT_S = 110.0  # a cold start compiles the tick

Popen = subprocess.Popen[str]


class Rack:
    """Loop processes on one block; what is left of them is killed at the end."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "block"
        self.started: list[Popen] = []

    def spawn(self, *arguments: str, preexec: Callable[[], None] | None = None) -> Popen:
        process = subprocess.Popen(
            [sys.executable, "-m", "rtcore", "--block", str(self.path), *arguments],
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=preexec,
        )
        self.started.append(process)
        return process

    def start(self, *arguments: str, preexec: Callable[[], None] | None = None) -> Popen:
        """A loop whose block is in its place and that has ticked a hundred times."""
        process = self.spawn(*arguments, preexec=preexec)
        wait_for(process, lambda: self.path.exists() and self.pid() == process.pid)
        self.let_tick(process, 100)
        return process

    def pid(self) -> int:
        return int(attach_block(self.path).fields["loop_pid"])

    def let_tick(self, process: Popen, ticks: int) -> None:
        reader = telemetry_reader(attach_block(self.path))
        wanted = reader.published + ticks
        wait_for(process, lambda: reader.published >= wanted)

    def records(self) -> Any:
        return telemetry_reader(attach_block(self.path)).read(1 << 20).records


def wait_for(process: Popen, condition: Callable[[], bool]) -> None:
    """Wait until something is so, while the process lives."""
    give_up = time.monotonic() + START_LIMIT_S
    while not condition():
        assert process.poll() is None, f"the loop has ended: {process.communicate()[1]}"
        assert time.monotonic() < give_up, "the loop does not get there"
        time.sleep(0.002)


@pytest.fixture
def rack() -> Iterator[Rack]:
    with tempfile.TemporaryDirectory(dir="/dev/shm", prefix="forcerig-test-") as folder:
        rack = Rack(Path(folder))
        yield rack
        for process in rack.started:
            if process.poll() is None:
                process.kill()
                process.communicate()


def end(process: Popen, number: int = signal.SIGTERM) -> str:
    """Ask the process to end; returns what it said. It must end by itself."""
    process.send_signal(number)
    said = process.communicate(timeout=30)[1]
    assert process.returncode == 0, said
    return said


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_it_ticks_without_a_gap_until_it_is_asked_to_end(rack: Rack, number: int) -> None:
    process = rack.start()
    rack.let_tick(process, 1000)
    said = end(process, number)
    records = rack.records()
    assert np.array_equal(records["tick"], np.arange(len(records)))
    assert f"ended after {len(records)} ticks" in said
    assert not loop_is_running(rack.path)


def test_whoever_finds_the_block_finds_a_living_loop(rack: Rack) -> None:
    process = rack.spawn()
    wait_for(process, rack.path.exists)
    fields = attach_block(rack.path).fields
    assert fields["loop_pid"] == process.pid
    assert 0 < fields["loop_started_ns"] <= fields["loop_heartbeat_ns"]
    assert json.loads(fields["conditions"])
    assert [p.name for p in rack.path.parent.iterdir() if p.name.startswith(".")] == []


def test_the_heartbeat_goes_on_and_stops_with_the_process(rack: Rack) -> None:
    process = rack.start()
    fields = attach_block(rack.path).fields
    first = int(fields["loop_heartbeat_ns"])
    rack.let_tick(process, 10)
    assert first < fields["loop_heartbeat_ns"] <= time.monotonic_ns()
    end(process)
    last = int(fields["loop_heartbeat_ns"])
    assert last == fields["loop_heartbeat_ns"]


def test_a_second_loop_on_the_same_block_is_refused_in_one_line(rack: Rack) -> None:
    first = rack.start()
    second = rack.spawn()
    said = second.communicate(timeout=START_LIMIT_S)[1]
    assert second.returncode == 2
    assert said == "rtcore: another loop already runs on block\n"
    assert rack.pid() == first.pid
    rack.let_tick(first, 100)


@pytest.mark.parametrize(
    ("text", "named"),
    [("supply: {high_pa: 1.0e9}", "high_pa"), ("supply: {", "rig.yaml"), (None, "rig.yaml")],
)
def test_a_rig_that_is_refused_leaves_nothing_behind(
    rack: Rack, text: str | None, named: str
) -> None:
    rig = rack.path.with_name("rig.yaml")
    if text is not None:
        rig.write_text(text)
    process = rack.spawn("--rig", str(rig))
    said = process.communicate(timeout=START_LIMIT_S)[1]
    assert process.returncode == 2
    assert re.fullmatch(f"rtcore: .*{named}.*\n", said), "one line that names what is wrong"
    assert {p.name for p in rack.path.parent.iterdir()} <= {"block.lock", "rig.yaml"}


def test_messages_go_to_the_log_file_where_one_is_named(rack: Rack) -> None:
    log = rack.path.with_name("loop.log")
    assert end(rack.start("--log", str(log))) == ""
    assert "sched_fifo: " in log.read_text()


def stop(process: Popen) -> None:
    """SIGSTOP, and wait until the process does stand."""
    process.send_signal(signal.SIGSTOP)
    _, status = os.waitpid(process.pid, os.WUNTRACED)
    assert os.WIFSTOPPED(status)


@pytest.mark.parametrize("stop_ms", [1, 10, 500])
def test_a_stopped_loop_counts_what_it_missed_and_never_catches_up(
    rack: Rack, stop_ms: int
) -> None:
    process = rack.start()
    block = attach_block(rack.path)
    reader = telemetry_reader(block)
    stop(process)
    stopped_at = reader.published
    missed_before = int(block.ring["deadlines_missed"][stopped_at - 1])
    time.sleep(stop_ms * 1e-3)
    continued_ns = time.monotonic_ns()
    process.send_signal(signal.SIGCONT)
    rack.let_tick(process, 40)
    executed = reader.published - stopped_at
    elapsed = (time.monotonic_ns() - continued_ns) / PERIOD_NS
    # One for the tick that was under way, one for the deadline that was just passed.
    assert executed <= elapsed + 2, "a burst"
    assert block.ring["deadlines_missed"][stopped_at + 1] - missed_before >= stop_ms * 4 - 2
    end(process)
    every_deadline_was_served_or_missed(block)
    each_miss_follows_from_its_lateness(rack.records())


def every_deadline_was_served_or_missed(block: Block) -> None:
    """Neither a tick nor a miss more than time has gone by."""
    last = block.ring[int(block.fields["telemetry_published"]) - 1]
    deadlines = int(last["tick"]) + 1 + int(last["deadlines_missed"])
    lived_ns = int(block.fields["loop_heartbeat_ns"]) - int(block.fields["loop_started_ns"])
    assert deadlines <= lived_ns // PERIOD_NS


def each_miss_follows_from_its_lateness(records: Any) -> None:
    """A wake-up that is n and a bit periods late has missed n deadlines."""
    missed = np.diff(records["deadlines_missed"], prepend=0)
    lateness = records["wakeup_latency_s"].astype(float) / PERIOD_S
    rounding = 1e-3  # of float32
    assert np.all(missed <= lateness + rounding)
    assert np.all(missed > lateness - 1 - rounding)


def test_killed_and_started_again_it_is_tripped_on_a_block_of_its_own(rack: Rack) -> None:
    first = rack.start()
    block_of_first = attach_block(rack.path)
    first.kill()
    first.communicate()
    left = block_of_first.fields["telemetry_published"]
    second = rack.start()
    assert rack.pid() == second.pid
    assert set(rack.records()["mode"].tolist()) == {Mode.TRIPPED}
    records = telemetry_reader(block_of_first).read(1 << 20).records
    assert len(records) == left > 0, "what the first one measured is still there"


CAP_SYS_NICE, CAP_IPC_LOCK = 23, 14
PR_CAPBSET_DROP = 24


def without_permissions() -> None:
    """Neither FIFO nor locked memory, even for root."""
    libc = ctypes.CDLL(None)
    for capability in (CAP_SYS_NICE, CAP_IPC_LOCK):
        libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)
    resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
    resource.setrlimit(resource.RLIMIT_MEMLOCK, (65536, 65536))


def conditions_told(rack: Rack) -> dict[str, bool]:
    told = json.loads(attach_block(rack.path).fields["conditions"])
    assert all(condition["reason"] for condition in told)
    return {condition["name"]: condition["had"] for condition in told}


def conditions_seen(pid: int) -> dict[str, bool]:
    """The same conditions, from what the kernel tells about the process."""
    proc = Path(f"/proc/{pid}")
    locked = re.search(r"VmLck:\s+(\d+)", (proc / "status").read_text())
    held = {str(entry.readlink()) for entry in (proc / "fd").iterdir()}
    return {
        "affinity": len(os.sched_getaffinity(pid)) == 1,
        "mlockall": locked is not None and int(locked[1]) > 0,
        "sched_fifo": os.sched_getscheduler(pid) == os.SCHED_FIFO,
        "cpu_dma_latency": "/dev/cpu_dma_latency" in held,
    }


def test_the_block_tells_the_conditions_as_the_kernel_does(rack: Rack) -> None:
    process = rack.start()
    told = conditions_told(rack)
    seen = conditions_seen(process.pid)
    assert {name: told[name] for name in seen} == seen


def test_without_permissions_it_runs_and_says_what_it_lacks(rack: Rack) -> None:
    process = rack.start(preexec=without_permissions)
    told = conditions_told(rack)
    assert not told["sched_fifo"]
    assert not told["mlockall"]
    seen = conditions_seen(process.pid)
    assert {name: told[name] for name in seen} == seen
    assert "WARNING sched_fifo: no permission: needs CAP_SYS_NICE" in end(process)


def test_the_processor_is_the_one_that_was_asked_for(rack: Rack) -> None:
    first = min(os.sched_getaffinity(0))
    process = rack.start("--cpu", str(first))
    assert os.sched_getaffinity(process.pid) == {first}
