"""A console of its own with a loop, recording in real time while a client watches every tick of it."""

import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event, Thread
from typing import Any

import httpx2
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app.access.schemas import TokenCreate
from app.access.scopes import Scope
from app.commands.tokens import make_token
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.settings import Settings
from bench.report import progress

PATIENCE_S = 120.0
_SERVE = "from app.main import serve; serve('127.0.0.1', 0, None)"
_HEADER = struct.Struct("<BBHIqII")
WATCHED = ("force_command_n", "force_n", "displacement_m", "valve_command", "pressure_1_pa")
LOOK_S = 1.0


@dataclass
class Watched:
    """What was seen of a run; memory in bytes at each look, processor time as a share of one."""

    run: dict[str, Any] = field(default_factory=dict)
    seen_ticks: int = 0
    lost_ticks: int = 0
    times_s: list[float] = field(default_factory=list)
    app_bytes: list[int] = field(default_factory=list)
    app_share: float = 0.0
    loop_share: float = 0.0
    part_bytes: int = 0
    file_bytes: int = 0
    request_s: dict[str, float] = field(default_factory=dict)


def measure(minutes: float) -> Watched:
    """Record a harmonic test of so many minutes."""
    with tempfile.TemporaryDirectory(prefix="forcerig-bench-") as folder, _console(folder) as api:
        data = Path(folder) / "data"
        found = Watched()
        _make_ready(api)
        run_id = _start(api, minutes * 60.0)
        stop = Event()
        client = Thread(target=_watch, args=(api, found, stop), daemon=True)
        client.start()
        _look_on(api, run_id, data, found)
        stop.set()
        client.join()
        found.file_bytes = (data / "runs" / str(run_id) / "run.parquet").stat().st_size
        found.request_s = _requests(api, run_id, found.run["duration_s"])
        return found


@contextmanager
def _console(folder: str) -> Iterator[httpx2.Client]:
    interlocks = default_interlocks().model_dump(mode="json")
    for detector in interlocks["detectors"]:
        if detector["name"] == "deadlines_missed":  # other work may hold up this machine
            detector["threshold"] = 1e6
    interlocks["knowingly_weaker"] = ["deadlines_missed"]
    table = Path(folder) / "interlocks.json"
    table.write_text(json.dumps(interlocks))
    environment = os.environ | {
        "FORCERIG_DATA_DIR": str(Path(folder) / "data"),
        "FORCERIG_INTERLOCKS_FILE": str(table),
    }
    token = _token(Path(folder) / "data")
    log = Path(folder) / "console.log"
    with log.open("ab") as out:
        process = subprocess.Popen(
            [sys.executable, "-c", _SERVE], env=environment, stdout=out, stderr=out
        )
    try:
        found = _until(lambda: re.search(r"forcerig console: (\S+)/\n", log.read_text()), "address")
        with httpx2.Client(base_url=f"{found.group(1)}/api/v1", timeout=60) as api:
            api.headers["Authorization"] = f"Bearer {token}"
            api.headers["X-Process"] = str(process.pid)
            yield api
    finally:
        process.terminate()
        process.wait(60)


def _token(data: Path) -> str:
    asked = TokenCreate(name="benchmark", scope=Scope.ADMIN, expires_in_days=1)
    made = make_token(Settings(data_dir=data), "admin", asked)
    if isinstance(made, Refusal):
        raise RuntimeError(made.detail)
    return made.token


def _until(condition: Callable[[], Any], what: str) -> Any:
    give_up = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        if time.monotonic() > give_up:
            raise RuntimeError(f"waited {PATIENCE_S:.0f} s for the {what} of the console")
        time.sleep(0.05)
    return found


def _status(api: httpx2.Client) -> dict[str, Any]:
    try:
        status: dict[str, Any] = api.get("/rig").json()
    except httpx2.TransportError:
        return {"mode": "starting", "loop": {"alive": False}}
    return status


def _make_ready(api: httpx2.Client) -> None:
    _until(lambda: _status(api)["loop"]["alive"], "loop")
    api.post("/lease", json={"reason": "Benchmark", "ttl_s": 600}).raise_for_status()
    for command in ("reset", "pressurise"):
        api.post("/rig/commands", json={"command": command}).raise_for_status()
    _until(lambda: _status(api)["commands"]["start"] is None, "pressure")


def _start(api: httpx2.Client, duration_s: float) -> int:
    definition = {
        "schema": 1,
        "name": "Recording benchmark",
        "blocks": [
            {
                "kind": "harmonic",
                "mean_n": 0,
                "amplitude_n": 2000,
                "frequency_hz": 5,
                "duration_s": duration_s,
            }
        ],
        "motion": [
            {
                "kind": "harmonic",
                "amplitude_m": 0.002,
                "frequency_hz": 4,
                "duration_s": duration_s,
            }
        ],
    }
    test = api.post("/tests", json={"definition": definition}).raise_for_status().json()
    asked = {"test_id": test["id"], "override_reason": "Benchmark"}
    return int(api.post("/runs", json=asked).raise_for_status().json()["id"])


def _watch(api: httpx2.Client, found: Watched, stop: Event) -> None:
    """What a browser does: five channels, every tick."""
    url = str(api.base_url).replace("http", "ws").rstrip("/") + "/live"
    credentials = {"Authorization": api.headers["Authorization"]}
    with connect(url, max_size=None, additional_headers=credentials) as stream:
        wanted = {"type": "subscribe", "subscription": 1, "channels": WATCHED}
        stream.send(json.dumps(wanted))
        while not stop.is_set():
            try:
                frame = stream.recv(1.0)
            except TimeoutError:
                continue
            except ConnectionClosed:
                return
            if isinstance(frame, bytes):
                _, _, _, samples, _, lost, _ = _HEADER.unpack_from(frame)
                found.seen_ticks += samples
                found.lost_ticks += lost


def _look_on(api: httpx2.Client, run_id: int, data: Path, found: Watched) -> None:
    """Until the run is in the book."""
    app, loop = int(api.headers["X-Process"]), int(_status(api)["loop"]["pid"])
    begun_s, app_s, loop_s = time.monotonic(), _processor_s(app), _processor_s(loop)
    while True:
        run = api.get(f"/runs/{run_id}").json()
        if run["outcome"] is not None:
            break
        parts = (data / "runs" / str(run_id)).glob("part-*.arrows")
        found.part_bytes = max(found.part_bytes, sum(part.stat().st_size for part in parts))
        if _status(api)["mode"] == "running":  # afterwards, the file is made and measured
            found.times_s.append(time.monotonic() - begun_s)
            found.app_bytes.append(_memory_bytes(app))
        time.sleep(LOOK_S)
    elapsed_s = time.monotonic() - begun_s
    found.app_share = (_processor_s(app) - app_s) / elapsed_s
    found.loop_share = (_processor_s(loop) - loop_s) / elapsed_s
    found.run = run
    progress(f"run {run_id}: {run['outcome']}, {run['ticks']} ticks")


def _requests(api: httpx2.Client, run_id: int, duration_s: float) -> dict[str, float]:
    """Over HTTP, JSON and all."""
    middle = duration_s / 2
    asked = {
        "overview": f"points=2000&to_s={duration_s}",
        "window_ticks": f"points=20000&from_s={middle}&to_s={middle + 4.9999}",
        "window_bins": f"points=2000&from_s={middle}&to_s={middle + 4.9999}",
    }
    return {
        name: _fastest(api, f"/runs/{run_id}/samples?channels=force_n&{query}")
        for name, query in asked.items()
    }


def _fastest(api: httpx2.Client, path: str) -> float:
    taken = []
    for _ in range(7):
        begun = time.perf_counter()
        api.get(path).raise_for_status()
        taken.append(time.perf_counter() - begun)
    return sorted(taken)[len(taken) // 2]


def _processor_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _memory_bytes(pid: int) -> int:
    """What is its own: pages of files that it has mapped are the system's to take back."""
    words = Path(f"/proc/{pid}/status").read_text()
    found = re.search(r"RssAnon:\s+(\d+) kB", words)
    return int(found.group(1)) * 1024 if found else 0
