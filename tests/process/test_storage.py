"""A real console on a real disk that fills up, and backups of one that runs."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from app.storage.backup import Source, back_up
from app.storage.restore import restore
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow, pytest.mark.timeout(300)]

SIZE_MB = 96
RESERVE_BYTES = 4_000_000
TEST = {
    "schema": 1,
    "name": "A minute",
    "blocks": [
        {
            "kind": "harmonic",
            "mean_n": 0,
            "amplitude_n": 500,
            "frequency_hz": 5,
            "duration_s": 60.0,
        }
    ],
}


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of its own."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={SIZE_MB}m", "tmpfs", str(folder)]
    if sys.platform != "linux" or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("a file system can only be mounted by root")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


@pytest.fixture
def console(small_disk: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[ConsoleProcess]:
    monkeypatch.setenv("FORCERIG_RESERVE_BYTES", str(RESERVE_BYTES))
    process = ConsoleProcess(small_disk)
    try:
        yield process.start()
    finally:
        process.clean_up()


def start(console: ConsoleProcess, recorded_s: float) -> int:
    """A run of a minute, once so much of it is recorded."""
    if console.http.get("/tests/a-minute").status_code == 404:
        answer = console.http.post("/tests", json={"definition": TEST, "id": "a-minute"})
        assert answer.is_success, answer.text
    console.make_ready()
    wait_for(lambda: console.status()["commands"]["start"] is None, "leave to start")
    asked = {"test_id": "a-minute", "override_reason": "Disk test"}
    answer = console.http.post("/runs", json=asked)
    assert answer.status_code == 201, answer.text
    wait_for(lambda: (console.status()["run"] or {}).get("elapsed_s", 0) > recorded_s, "ticks")
    return int(answer.json()["id"])


def storage(console: ConsoleProcess) -> dict[str, Any]:
    return dict(console.status()["storage"])


def fill(disk: Path, left_bytes: int) -> Path:
    """Take the room on the disk, but so much."""
    ballast = disk / "ballast"
    free = storage_free(disk) - left_bytes
    with ballast.open("wb", buffering=0) as file:
        try:
            for _ in range(0, free, 1 << 16):
                file.write(bytes(min(1 << 16, max(1, free - file.tell()))))
        except OSError:
            assert left_bytes == 0
    return ballast


def storage_free(disk: Path) -> int:
    status = os.statvfs(disk)
    return int(status.f_bavail * status.f_frsize)


def is_whole(console: ConsoleProcess, run: dict[str, Any]) -> None:
    """Every tick from the first to the last is in its file."""
    path = console.data / "runs" / str(run["id"]) / "run.parquet"
    ticks = pq.read_table(path, columns=["tick"])["tick"].to_numpy()
    assert np.array_equal(ticks, np.arange(run["first_tick"], run["last_tick"] + 1))
    assert run["missing_ticks"] == 0


@pytest.mark.parametrize("left_bytes", [RESERVE_BYTES, 0])
def test_a_disk_that_fills_up_stops_the_run_and_costs_no_tick(
    console: ConsoleProcess, small_disk: Path, left_bytes: int
) -> None:
    run_id = start(console, 2.0)
    assert storage(console)["state"] != "full"
    ballast = fill(small_disk, left_bytes)
    wait_for(lambda: console.mode() == "ready", "the stop")
    assert storage(console)["state"] == "full"
    if left_bytes == 0:
        assert console.status()["recorder"]["trouble"] == "No space left on device"
        time.sleep(2.0)  # nothing more can be written, and nothing dies of it
        ballast.unlink()
    run = console.ended_run(run_id)
    assert run["outcome"] == "stopped"
    assert run["reason"].startswith("Stopped: the disk was full (")
    assert run["duration_s"] < 55.0
    is_whole(console, run)
    ballast.unlink(missing_ok=True)
    wait_for(lambda: storage(console)["state"] != "full", "room")
    again = start(console, 0.5)
    assert console.command("stop").is_success
    is_whole(console, console.ended_run(again))


def test_a_backup_of_a_live_run_is_a_console_of_its_own(
    console: ConsoleProcess, small_disk: Path, tmp_path: Path
) -> None:
    first = start(console, 0.5)
    assert console.command("stop").is_success
    console.ended_run(first)
    second = start(console, 2.0)
    source = Source(console.data, console.data / "forcerig.sqlite")
    made = back_up(source, tmp_path / "backup.tar")
    assert (made.runs, made.under_way) == (2, 1)
    assert console.run(second)["outcome"] is None
    other = ConsoleProcess(tmp_path)
    restore(tmp_path / "backup.tar", other.data)
    try:
        other.start(wait=False)
        is_whole(other, other.ended_run(first))
        run = other.ended_run(second)
        assert run["outcome"] == "interrupted"
        assert run["ticks"] >= 1.5 * 4000
        is_whole(other, run)
        for run_id in (first, second):
            assert other.http.get(f"/runs/{run_id}/samples?channels=force_n").is_success
    finally:
        other.clean_up()
    assert console.command("stop").is_success
    is_whole(console, console.ended_run(second))


def test_a_time_history_that_finds_no_room_is_refused_and_ends_nobody(small_disk: Path) -> None:
    """A mapped file that the disk has no room for would end the console by a signal."""
    code = f"""
from pathlib import Path
from app.histories.store import import_history
text = [b"t,F\\n0,0\\n2000,1\\n"]
print(import_history(text, "long.csv", Path({str(small_disk)!r}), rate_hz=1e5).code.value)
"""
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (ended.returncode, ended.stdout.strip()) == (0, "no_space"), ended.stderr
    assert [path for path in small_disk.iterdir() if path.name != "lost+found"] == []
