"""kill -9 of the console, of the loop, of both: the load comes off, and nothing measured is lost."""

import os
import signal
import time
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from app.link.life import Life
from app.link.process import LoopCommand
from app.link.supervisor import Supervisor
from rtcore.memory.rings import telemetry_reader
from rtcore.memory.segment import (
    attach_block,
    create_block,
    lock_single_loop,
    loop_is_running,
)
from rtcore.modes import Mode, is_pressurised
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow, pytest.mark.timeout(300)]
LONG = "harmonic-2-kn-50-hz"
PERIOD_S = 250e-6
SILENCE_S = 0.5


def recorded(console: ConsoleProcess, run: dict[str, Any]) -> Any:
    """The table of a run, after a look that it holds every tick from the first to the last."""
    table = pq.read_table(console.data / "runs" / str(run["id"]) / "run.parquet")
    ticks = np.arange(run["first_tick"], run["last_tick"] + 1)
    assert np.array_equal(table["tick"].to_numpy(), ticks)
    assert (run["ticks"], run["missing_ticks"]) == (len(ticks), 0)
    return table


def is_gone(pid: int) -> bool:
    """Whether a process has ended, whoever is to collect it."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except FileNotFoundError:
        return True


def running(console: ConsoleProcess) -> int:
    """The number of a run that is well under way, part of it on disk."""
    console.start().make_ready()
    run_id = console.start_run(LONG)
    wait_for(lambda: (console.status()["run"] or {}).get("cycle", 0) >= 3, "some cycles")
    wait_for(lambda: console.status()["recorder"]["bytes"] > 0, "samples on disk")
    return run_id


def test_the_console_is_killed_in_mid_run(console: ConsoleProcess) -> None:
    run_id = running(console)
    block = attach_block(console.block)
    console.kill()
    silent_since_ns = int(block.fields["app_heartbeat_ns"])
    wait_for(lambda: block.fields["snapshot"]["mode"] == Mode.TRIPPED, "the loop to trip")
    assert int(block.fields["app_heartbeat_ns"]) == silent_since_ns
    console.start()
    status = console.status()
    assert status["mode"] == "tripped"
    assert [trip["code"] for trip in status["trips"] if trip["first"]] == ["app_silence"]

    run = console.ended_run(run_id)
    assert run["outcome"] == "tripped"
    assert run["reason"] == "Console silent for 0.50 s, limit 0.50 s"
    table = recorded(console, run)
    mode = table["mode"].to_numpy()
    stopped = int(np.argmax(mode == Mode.STOPPING))
    assert set(mode[:stopped]) == {Mode.RUNNING}
    assert np.abs(table["force_command_n"].to_numpy()[-1]) < 1.0
    assert np.abs(table["force_n"].to_numpy()[-200:]).max() < 500.0

    events = console.http.get(f"/runs/{run_id}/events").json()["events"]
    (trip,) = [event for event in events if event["kind"] == "trip"]
    print(f"\nconsole killed: stop after {trip['value']:.5f} s of silence, {run['ticks']} ticks, "
          f"{run['missing_ticks']} missing")  # fmt: skip
    assert trip["value"] == pytest.approx(SILENCE_S, abs=2 * PERIOD_S)
    assert trip["tick"] == run["first_tick"] + stopped
    assert not (console.data / "runs" / str(run_id) / "part-0001.arrows").exists()

    pid = console.loop_pid
    assert console.stop() == 0  # it ends a loop too that it did not start
    assert is_gone(pid)


def test_the_loop_is_killed_in_mid_run(console: ConsoleProcess) -> None:
    run_id = running(console)
    block, old_pid = attach_block(console.block), console.loop_pid
    os.kill(old_pid, signal.SIGKILL)
    seen: list[dict[str, Any]] = []

    def lost_is_told() -> bool:
        seen.append(console.status())
        return bool(seen[-1]["mode"] == "lost")

    wait_for(lost_is_told, "the loss to be told")
    lost = seen.pop()
    print(f"\nloop killed: told when its data were {lost['loop']['data_age_s']:.2f} s old")
    assert lost["loop"]["alive"] is False
    assert all(status["loop"]["data_age_s"] < 1.0 for status in seen)  # told within a second
    assert set(lost["commands"].values()) == {"The loop process does not run"}
    assert console.command("reset").json()["code"] == "loop_lost"

    run = console.ended_run(run_id)
    assert run["outcome"] == "interrupted"
    recorded(console, run)
    published = telemetry_reader(block).read(1 << 20).records
    assert published["run"][-1] == run_id
    assert run["last_tick"] == published["tick"][-1]

    wait_for(lambda: console.status()["loop"]["alive"], "a new loop")
    assert console.loop_pid != old_pid
    assert console.mode() == "tripped"
    console.make_ready()
    again = console.start_run("step-2-kn")
    assert again == run_id + 1
    recorded(console, console.ended_run(again))


def test_both_are_killed_in_mid_run(console: ConsoleProcess) -> None:
    run_id = running(console)
    pid = console.loop_pid
    block = attach_block(console.block)
    console.kill()
    os.kill(pid, signal.SIGKILL)
    wait_for(lambda: not loop_is_running(console.block), "the end of the loop")
    console.start()
    run = console.ended_run(run_id)
    assert run["outcome"] == "interrupted"
    recorded(console, run)
    assert run["last_tick"] == int(telemetry_reader(block).read(1 << 20).records["tick"][-1])
    assert console.mode() == "tripped"


def test_a_frozen_loop_is_lost_and_found_again(console: ConsoleProcess) -> None:
    console.start()
    pid = console.loop_pid
    os.kill(pid, signal.SIGSTOP)
    try:
        wait_for(lambda: console.status()["loop"]["data_age_s"] > 1.5, "the supervisor to look")
        assert console.mode() == "lost"
    finally:
        os.kill(pid, signal.SIGCONT)
    wait_for(lambda: console.status()["loop"]["alive"], "the loop again")
    assert console.loop_pid == pid  # it was not replaced while it held the lock


def test_a_clean_stop_leaves_no_load_no_pressure_and_no_process(console: ConsoleProcess) -> None:
    run_id = running(console)
    block, pid = attach_block(console.block), console.loop_pid
    assert console.stop() == 0
    assert is_gone(pid)
    assert not console.block.exists()
    last = telemetry_reader(block).read(1 << 20).records
    assert Mode(int(last["mode"][-1])) is Mode.OFF
    stopping = last["mode"][last["run"] == run_id]
    assert stopping[-1] == Mode.STOPPING
    console.start()
    run = console.run(run_id)
    assert (run["outcome"], run["reason"]) == ("stopped", "Stopped by the operator")
    recorded(console, run)


def test_ten_restarts_never_pressurise(console: ConsoleProcess) -> None:
    console.start()
    console.make_ready()
    seen: set[int] = set()
    for restart in range(10):
        if restart % 2:
            os.kill(console.loop_pid, signal.SIGKILL)
            wait_for(lambda: not loop_is_running(console.block), "the end of the loop")
        console.kill()
        if restart == 0:  # a rig that was ready when its console died
            fields = attach_block(console.block).fields
            wait_for(lambda: fields["snapshot"]["mode"] == Mode.TRIPPED, "the loop to trip")  # noqa: B023
        console.start()
        seen.add(console.loop_pid)
        status = console.status()
        assert status["mode"] == "tripped", restart
        assert status["commands"]["pressurise"].startswith("Press Reset first")
        ticks = telemetry_reader(attach_block(console.block)).read(1 << 20).records
        pressurised = [mode for mode in np.unique(ticks["mode"]) if is_pressurised(mode)]
        if restart > 0:
            assert pressurised == []
    assert len(seen) == 6  # the first, and one for each that was killed


def test_a_loop_of_another_version_is_left_alone(console: ConsoleProcess) -> None:
    console.start()
    console.kill()
    fields = attach_block(console.block).fields
    layout = int(fields["layout_hash"])
    fields["layout_hash"] = 4711
    with pytest.raises(AssertionError, match="stop that version first"):
        console.start()
    assert loop_is_running(console.block)
    fields["layout_hash"] = layout


def test_a_left_over_block_of_another_version_is_replaced(console: ConsoleProcess) -> None:
    create_block(console.block, 250_000, seconds=0.01).fields["layout_hash"] = 4711
    console.start()
    assert "laid out by another version" in console.said()
    assert console.mode() == "tripped"


def test_a_second_console_is_refused(console: ConsoleProcess, tmp_path: Path) -> None:
    console.start()
    second = ConsoleProcess(tmp_path)
    with pytest.raises(AssertionError, match="another console uses the data directory"):
        second.start()
    assert console.status()["loop"]["alive"]


def test_a_loop_that_cannot_start_is_tried_again_and_told(tmp_path: Path) -> None:
    block = tmp_path / "loop.block"
    command = LoopCommand(block, tmp_path / "loop.log", ("--block", str(block), "--nonsense"))
    supervisor = Supervisor(command, lambda life: None, lambda life: True)
    command.log.touch()
    supervisor.start()
    try:
        wait_for(lambda: not supervisor.starting, "the first failure")
        wait_for(lambda: command.log.read_text().count("--nonsense") >= 2, "a second attempt")
        assert supervisor.life is None
    finally:
        supervisor.stop()
        supervisor.reap()
    assert "unrecognized arguments" in command.last_words()


def lives_of(block: Path, log: Path) -> tuple[Supervisor, list[Life]]:
    """A supervisor that may start no loop of its own, and the lives that it is told of."""
    seen: list[Life] = []
    log.touch()
    command = LoopCommand(block, log, ("--block", str(block), "--nonsense"))
    return Supervisor(command, seen.append, lambda life: True), seen


def begin_to_beat(block: Path, started_ns: int) -> None:
    """What a loop does once it is ready: a block of its own in the old one's place, and beats."""
    fields = create_block(block, 250_000, seconds=0.1).fields
    fields["loop_started_ns"], fields["loop_pid"] = started_ns, os.getpid()
    fields["loop_heartbeat_ns"] = time.monotonic_ns() + 10**12


@pytest.mark.parametrize("has_old_block", [True, False])
def test_a_loop_that_its_console_did_not_live_to_see_is_found(
    tmp_path: Path, has_old_block: bool
) -> None:
    """The console is killed while its new loop still compiles; the next console waits for that loop."""
    block = tmp_path / "loop.block"
    if has_old_block:
        create_block(block, 250_000, seconds=0.1).fields["loop_pid"] = 1
    with lock_single_loop(block):
        supervisor, seen = lives_of(block, tmp_path / "loop.log")
        supervisor.start()
        try:
            assert len(seen) == has_old_block
            begin_to_beat(block, started_ns=77)
            wait_for(lambda: seen and seen[-1].name == f"77-{os.getpid()}", "the loop", 20)
            assert supervisor.life is seen[-1]
            assert seen[-1].alive
            assert all(life.ended for life in seen[:-1])
            assert (tmp_path / "loop.log").read_text() == ""
        finally:
            supervisor.stop()
            supervisor.reap()
