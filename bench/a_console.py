"""A console of a benchmark's own, with its loop, and what an operator does with it."""

import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx2

from app.access.schemas import TokenCreate
from app.access.scopes import Scope
from app.commands.tokens import make_token
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.settings import Settings

PATIENCE_S = 120.0
_SERVE = "from app.main import serve; serve('127.0.0.1', 0, None)"


@contextmanager
def console(folder: str) -> Iterator[httpx2.Client]:
    """A console on a folder of its own; the client bears a token, and the process id as a header."""
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
        found = until(lambda: re.search(r"forcerig console: (\S+)/\n", log.read_text()), "address")
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


def until(condition: Callable[[], Any], what: str) -> Any:
    """Wait until something is so, and return it. Raises RuntimeError where it does not come."""
    give_up = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        if time.monotonic() > give_up:
            raise RuntimeError(f"waited {PATIENCE_S:.0f} s for the {what} of the console")
        time.sleep(0.05)
    return found


def status(api: httpx2.Client) -> dict[str, Any]:
    """The status of the rig."""
    try:
        now: dict[str, Any] = api.get("/rig").json()
    except httpx2.TransportError:
        return {"mode": "starting", "loop": {"alive": False}}
    return now


def make_ready(api: httpx2.Client) -> None:
    """Take command, reset, pressurise."""
    until(lambda: status(api)["loop"]["alive"], "loop")
    api.post("/lease", json={"reason": "Benchmark", "ttl_s": 600}).raise_for_status()
    for command in ("reset", "pressurise"):
        api.post("/rig/commands", json={"command": command}).raise_for_status()
    until(lambda: status(api)["commands"]["start"] is None, "pressure")


def start(api: httpx2.Client, duration_s: float) -> int:
    """Start a harmonic load on a moving unit; returns the number of the run."""
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


def processor_s(pid: int) -> float:
    """What a process has had of the processors."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_bytes(pid: int) -> int:
    """What is its own: pages of files that it has mapped are the system's to take back."""
    words = Path(f"/proc/{pid}/status").read_text()
    found = re.search(r"RssAnon:\s+(\d+) kB", words)
    return int(found.group(1)) * 1024 if found else 0
