"""A console of its own with a loop, recording in real time while a client watches every tick of it."""

import json
import struct
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event, Thread
from typing import Any

import httpx2
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from bench.a_console import console, make_ready, memory_bytes, processor_s, start, status
from bench.report import progress

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
    with tempfile.TemporaryDirectory(prefix="forcerig-bench-") as folder, console(folder) as api:
        data = Path(folder) / "data"
        found = Watched()
        make_ready(api)
        run_id = start(api, minutes * 60.0)
        stop = Event()
        client = Thread(target=_watch, args=(api, found, stop), daemon=True)
        client.start()
        _look_on(api, run_id, data, found)
        stop.set()
        client.join()
        found.file_bytes = (data / "runs" / str(run_id) / "run.parquet").stat().st_size
        found.request_s = _requests(api, run_id, found.run["duration_s"])
        return found


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
    app, loop = int(api.headers["X-Process"]), int(status(api)["loop"]["pid"])
    begun_s, app_s, loop_s = time.monotonic(), processor_s(app), processor_s(loop)
    while True:
        run = api.get(f"/runs/{run_id}").json()
        if run["outcome"] is not None:
            break
        parts = (data / "runs" / str(run_id)).glob("part-*.arrows")
        found.part_bytes = max(found.part_bytes, sum(part.stat().st_size for part in parts))
        if status(api)["mode"] == "running":  # afterwards, the file is made and measured
            found.times_s.append(time.monotonic() - begun_s)
            found.app_bytes.append(memory_bytes(app))
        time.sleep(LOOK_S)
    elapsed_s = time.monotonic() - begun_s
    found.app_share = (processor_s(app) - app_s) / elapsed_s
    found.loop_share = (processor_s(loop) - loop_s) / elapsed_s
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
