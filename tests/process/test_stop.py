"""Stop on its own path: whatever else is blocked, busy, locked, gone or in somebody else's hands."""

import os
import signal
import socket
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest

from app.access.principal import Role
from rtcore.codes import EventKind
from rtcore.memory.rings import event_reader
from rtcore.memory.segment import attach_block
from rtcore.memory.snapshot import read_snapshot
from rtcore.modes import Mode
from tests.console_process import SERVE, ConsoleProcess, bearer, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
LONG = "flight-spectrum"

# The console with two routes more: one never gives the event loop back, one takes every thread
# for commands until it is asked again.
PROGRAM = f"""
from threading import Event
import app.main as main
from fastapi import Request
from starlette.routing import Route

create_app, held = main.create_app, []

async def block(request):
    open(request.query_params["marker"], "w").close()
    while True:
        pass

async def busy(request):
    from starlette.responses import Response
    threads = request.app.state.console.command_threads
    if held:
        held.pop().set()
    else:
        held.append(Event())
        for _ in range(threads._max_workers):
            threads.submit(held[0].wait)
    return Response()

def with_more_routes(*given, **named):
    app = create_app(*given, **named)
    for route in (block, busy):
        app.router.routes.insert(0, Route(f"/test/{{route.__name__}}", route, methods=["POST"]))
    return app

main.create_app = with_more_routes
{SERVE}
"""


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ConsoleProcess]:
    process = ConsoleProcess(tmp_path_factory.mktemp("stop"), program=PROGRAM)
    try:
        yield process.start()
    finally:
        process.clean_up()


@pytest.fixture
def viewer(shared: ConsoleProcess) -> str:
    """The token of somebody who may look, and stop the rig."""
    token = shared.new_token(Role.VIEWER)
    with shared.client(token) as client:
        client.get("/rig").raise_for_status()
    return token


@pytest.fixture
def running(shared: ConsoleProcess, viewer: str) -> ConsoleProcess:
    """A test runs, and the lease is somebody's who is not the viewer."""
    shared.make_ready()
    shared.start_run(LONG)
    return shared


def mode(console: ConsoleProcess) -> Mode:
    """As the loop itself has it."""
    record = wait_for(lambda: read_snapshot(attach_block(console.block)), "a whole snapshot")
    return Mode(int(record["mode"]))


def stop(console: ConsoleProcess, token: str, url: str) -> None:
    """Ask on the path of its own, and see the load go."""
    answer = httpx2.post(url, headers=bearer(token), timeout=30)
    assert answer.status_code == 200, answer.text
    assert answer.json()["mode"] in ("stopping", "ready")
    wait_for(lambda: mode(console) is Mode.READY, "the load to be off")


def stops_asked(console: ConsoleProcess) -> list[bool]:
    """Of each Stop on the path of its own, whether there was something to stop."""
    events = event_reader(attach_block(console.block)).read().records
    return [bool(event["code"]) for event in events if event["kind"] == EventKind.STOP_ASKED]


def forcerig_stop(console: ConsoleProcess) -> subprocess.CompletedProcess[str]:
    code = "from app.cli import main; main()"
    words = [sys.executable, "-c", code, "stop", "--data", str(console.data)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def test_it_says_how_the_rig_is_and_stops_it(running: ConsoleProcess, viewer: str) -> None:
    url = running.status()["stop_url"]
    state = httpx2.get(url, headers=bearer(viewer)).json()
    assert state["mode"] == "running"
    stop(running, viewer, url)
    assert stops_asked(running)[-1]
    again = httpx2.post(url, headers=bearer(viewer))
    assert again.json()["mode"] == "ready"
    assert not stops_asked(running)[-1]


def test_the_pages_may_ask_across_the_ports(shared: ConsoleProcess) -> None:
    url = shared.status()["stop_url"]
    policy = httpx2.get(f"{shared.url}/healthz").headers["content-security-policy"]
    assert f"connect-src 'self' {url.removesuffix('/stop')};" in policy
    answer = httpx2.post(url, headers={"origin": shared.url})
    assert answer.status_code == 401
    assert answer.headers["access-control-allow-origin"] == shared.url


def test_it_is_in_the_audit(shared: ConsoleProcess, viewer: str) -> None:
    httpx2.post(shared.status()["stop_url"], headers=bearer(viewer)).raise_for_status()

    def found() -> bool:
        asked = {"action": "rig.stop", "who": "viewer (tests)"}
        return bool(shared.http.get("/audit", params=asked).json()["entries"])

    wait_for(found, "its row")


def test_every_thread_for_commands_is_busy(running: ConsoleProcess, viewer: str) -> None:
    url = running.status()["stop_url"]
    httpx2.post(f"{running.url}/test/busy").raise_for_status()
    try:
        stop(running, viewer, url)
    finally:
        httpx2.post(f"{running.url}/test/busy").raise_for_status()


@pytest.mark.parametrize("what", ["locked", "gone"])
def test_the_database_is_down(running: ConsoleProcess, viewer: str, what: str) -> None:
    url, file = running.status()["stop_url"], running.data / "forcerig.sqlite"
    aside = file.with_suffix(".aside")
    holder = sqlite3.connect(file, isolation_level=None)
    if what == "locked":
        holder.execute("BEGIN EXCLUSIVE")
    else:
        file.rename(aside)
    try:
        stop(running, viewer, url)
    finally:
        if what == "locked":
            holder.execute("ROLLBACK")
        else:
            aside.replace(file)
        holder.close()


def test_the_command_line_stops_it(running: ConsoleProcess) -> None:
    done = forcerig_stop(running)
    assert (done.returncode, done.stdout) == (0, "Stopping\n"), done.stderr
    assert stops_asked(running)[-1]
    wait_for(lambda: mode(running) is Mode.READY, "the load to be off")
    done = forcerig_stop(running)
    assert (done.returncode, done.stdout) == (0, "Nothing to stop: ready\n"), done.stderr


def test_the_command_line_needs_no_console(running: ConsoleProcess) -> None:
    before = len(stops_asked(running))
    running.signal(signal.SIGSTOP)
    try:
        done = forcerig_stop(running)
        assert done.returncode == 0, done.stderr
        assert len(stops_asked(running)) == before + 1
    finally:
        running.signal(signal.SIGCONT)


def test_a_loop_that_stands_still_is_told_and_nobody_pretends(
    running: ConsoleProcess, viewer: str
) -> None:
    url = running.status()["stop_url"]
    os.kill(running.loop_pid, signal.SIGSTOP)
    try:
        answer = httpx2.post(url, headers=bearer(viewer), timeout=30)
        assert answer.json()["code"] in ("loop_silent", "loop_lost")
        assert "emergency stop" in answer.json()["detail"]
        assert forcerig_stop(running).returncode == 1
    finally:
        os.kill(running.loop_pid, signal.SIGCONT)
    wait_for(lambda: mode(running) not in (Mode.RUNNING, Mode.HOLDING), "the load to go")


def test_the_event_loop_is_blocked(running: ConsoleProcess, viewer: str, tmp_path: Path) -> None:
    """The last of this console: it never comes back."""
    url, marker = running.status()["stop_url"], tmp_path / "blocked"
    where = httpx2.URL(running.url)
    request = f"POST /test/block?marker={marker} HTTP/1.1\r\nHost: {where.host}\r\n\r\n"
    with socket.create_connection((where.host, where.port or 0)) as client:
        client.sendall(request.encode())
        wait_for(marker.exists, "the event loop to be blocked")
        stop(running, viewer, url)
        assert stops_asked(running)[-1]


def test_without_a_loop_the_command_line_says_so(tmp_path: Path) -> None:
    words = [sys.executable, "-c", "from app.cli import main; main()", "stop", "--data"]
    done = subprocess.run([*words, str(tmp_path)], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "does not run" in done.stderr
