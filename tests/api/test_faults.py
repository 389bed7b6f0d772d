"""A console with a real loop under a test, and what people, browsers and other work do to it meanwhile."""

import json
import os
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

import httpx2
import numpy as np
import pyarrow.parquet as pq
import pytest
from websockets.sync.client import connect

from app.access.principal import Role
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
LONG, STEP = "flight-spectrum", "step-2-kn"
PATIENCE_S = 30


@pytest.fixture
def finished(ready: ConsoleProcess) -> int:
    """A run that is over, to be asked for."""
    run_id = ready.start_run(STEP)
    ready.ended_run(run_id)
    ready.make_ready()
    return run_id


def is_whole(console: ConsoleProcess, run: dict[str, Any]) -> None:
    """Every tick from the first to the last, in its file."""
    path = console.data / "runs" / str(run["id"]) / "run.parquet"
    ticks = pq.read_table(path, columns=["tick"])["tick"].to_numpy()
    assert np.array_equal(ticks, np.arange(run["first_tick"], run["last_tick"] + 1))
    assert run["missing_ticks"] == 0


def live(console: ConsoleProcess) -> str:
    return console.url.replace("http", "ws") + "/api/v1/live"


def test_a_browser_that_vanishes_loses_command_and_the_test_goes_on(ready: ConsoleProcess) -> None:
    """It has beaten over its stream, and is gone without a word."""
    ready.start_run(LONG)
    token = ready.new_token(Role.ENGINEER)
    with ready.client(token) as browser:
        over = {"take_over": True, "reason": "A browser", "ttl_s": 5}
        epoch = browser.post("/lease", json=over).json()["epoch"]
    headers = {"Authorization": f"Bearer {token}"}
    with connect(live(ready), additional_headers=headers, close_timeout=0.1) as stream:
        stream.send(json.dumps({"type": "beat", "epoch": epoch}))
        assert stream.recv(PATIENCE_S)
        stream.socket.shutdown(socket.SHUT_RDWR)  # as of a browser that has crashed
    wait_for(lambda: ready.status()["lease"] is None, "the end of the lease")
    assert ready.mode() == "running"
    assert ready.command("stop").is_success


def test_of_many_who_take_command_at_once_one_has_it(console: ConsoleProcess) -> None:
    console.take_command()
    console.http.delete("/lease").raise_for_status()
    tokens = [console.new_token(Role.OPERATOR) for _ in range(6)]

    def take(token: str) -> httpx2.Response:
        with console.client(token) as client:
            return client.post("/lease", json={"reason": "At once", "ttl_s": 5})

    with ThreadPoolExecutor(len(tokens)) as people:
        answers = list(people.map(take, tokens))
    assert sorted(answer.status_code for answer in answers) == [200, *[409] * 5]
    epoch = next(answer.json()["epoch"] for answer in answers if answer.is_success)
    assert console.status()["lease"]["epoch"] == epoch


MALFORMED = {
    "no mask": bytes([0x81, 0x02]) + b"{}",
    "reserved bits": bytes([0xF1, 0x80]) + bytes(4),
    "unknown opcode": bytes([0x83, 0x80]) + bytes(4),
    "fragmented ping": bytes([0x09, 0x80]) + bytes(4),
    "no UTF-8": bytes([0x81, 0x82]) + bytes(4) + b"\xff\xfe",
    "goes on with nothing": bytes([0x80, 0x80]) + bytes(4),
    "claims 2^62 bytes": bytes([0x82, 0xFF]) + struct.pack(">Q", 1 << 62) + bytes(4),
    "noise": bytes(range(7, 250, 3)),
}


@pytest.mark.parametrize("sent", MALFORMED.values(), ids=MALFORMED.keys())
def test_a_malformed_frame_ends_that_stream_and_no_other(
    console: ConsoleProcess, sent: bytes
) -> None:
    with (
        connect(live(console), additional_headers=console.headers) as good,
        connect(live(console), additional_headers=console.headers) as bad,
    ):
        bad.socket.sendall(sent)
        bad.recv_events_thread.join(PATIENCE_S)
        assert not bad.recv_events_thread.is_alive()
        assert bad.protocol.close_rcvd is None or bad.protocol.close_rcvd.code in (1002, 1007, 1009)
        good.send("{}")
        while json.loads(good.recv(PATIENCE_S, decode=True))["type"] != "error":
            pass


@contextmanager
def at_work(program: str, count: int) -> Iterator[None]:
    """So many processes that do nothing else, and each has begun."""
    words = [sys.executable, "-c", program]
    started = [subprocess.Popen(words, stdout=subprocess.PIPE) for _ in range(count)]
    try:
        for process in started:
            assert process.stdout is not None
            assert process.stdout.read(1) == b"."
        yield
    finally:
        for process in started:
            process.send_signal(signal.SIGKILL)
            process.communicate()


BUSY = "import os; os.write(1, b'.')\nwhile True: pass"
GREEDY = """
import os
pages = bytearray(300_000_000)
os.write(1, b'.')
while True:
    for at in range(0, len(pages), 4096): pages[at] = (pages[at] + 1) % 256
"""


@pytest.mark.parametrize("program", [BUSY, GREEDY], ids=["processors", "memory"])
def test_other_work_costs_no_tick(ready: ConsoleProcess, program: str) -> None:
    """What the loop missed is counted; it makes nothing up for it, and its run is whole."""
    run_id = ready.start_run(STEP)
    with at_work(program, 2 * (os.cpu_count() or 1) if program is BUSY else 1):
        run = ready.ended_run(run_id)
    is_whole(ready, run)
    path = ready.data / "runs" / str(run_id) / "run.parquet"
    table = pq.read_table(path, columns=["deadlines_missed", "wakeup_latency_s"])
    missed = np.diff(table["deadlines_missed"].to_numpy())
    lateness = table["wakeup_latency_s"].to_numpy()[1:].astype(float) / 250e-6
    print(f"\n{missed.sum()} deadlines missed in {run['ticks']} ticks, {lateness.max():.1f} late")
    assert (missed <= lateness + 1e-3).all()
    assert (missed > lateness - 1 - 1e-3).all(), "made up for: a burst"


def test_a_large_request_during_a_run_costs_no_tick(ready: ConsoleProcess, finished: int) -> None:
    """A file as a whole, and charts, again and again."""
    run_id = ready.start_run(STEP)
    asked = 0
    while ready.run(run_id)["outcome"] is None:
        for path in (
            f"/runs/{finished}/data.parquet",
            f"/runs/{finished}/samples?channels=force_n,mode",
        ):
            ready.http.get(path).raise_for_status()
            asked += 1
    assert asked >= 2
    is_whole(ready, ready.run(run_id))


@pytest.mark.timeout(300)  # it gives way to whatever else this machine does
def test_reports_made_during_a_run_cost_no_tick(ready: ConsoleProcess, finished: int) -> None:
    """Made anew, in a process apart: the run that it is of has another note now."""
    run_id = ready.start_run(STEP)
    noted = {"notes": "reported", "annotation": ready.run(finished)["annotation"]}
    ready.http.patch(f"/runs/{finished}", json=noted).raise_for_status()
    report = ready.http.get(f"/runs/{finished}/report.pdf", timeout=120)
    assert report.status_code == 200, report.text
    assert report.content.startswith(b"%PDF")
    is_whole(ready, ready.ended_run(run_id))


def test_a_report_of_a_run_under_way_is_refused(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(STEP)
    refused = ready.http.get(f"/runs/{run_id}/report.pdf")
    assert (refused.status_code, refused.json()["code"]) == (409, "run_under_way")
    assert "once it has ended" in refused.json()["detail"]
    ready.ended_run(run_id)
    html = ready.http.get(f"/runs/{run_id}/report.html?extent=brief", timeout=120)
    assert html.status_code == 200, html.text
    assert html.headers["content-disposition"].startswith("attachment")


def test_two_runs_beside_one_another_as_a_report(ready: ConsoleProcess, finished: int) -> None:
    run_id = ready.start_run(STEP)
    ready.ended_run(run_id)
    report = ready.http.get(f"/runs/compare/report.pdf?ids={finished},{run_id}", timeout=120)
    assert report.status_code == 200, report.text
    assert report.content.startswith(b"%PDF")
    for ids, status in ((f"{run_id},{run_id}", 422), ("x,y", 422), (f"{run_id},999999", 404)):
        assert ready.http.get(f"/runs/compare/report.pdf?ids={ids}").status_code == status
