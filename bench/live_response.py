"""`forcerig bench live_response`: how long after its last cycle a point of a frequency response is with a client.

A real console and loop; the client reads the live stream as a browser does, and tells the time of a tick by
the samples that it gets.
"""

import json
import struct
import tempfile
import time
from typing import Any

import numpy as np
from websockets.sync.client import connect

from app.analysis.evidence import Kind
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.definitions.windows import stretches
from bench.a_console import console, make_ready
from bench.report import Figure, show

FREQUENCIES_HZ = [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0]
CYCLES = 6
AT_MOST_S = 0.5
_HEADER = struct.Struct("<BBHIqII")
_WAIT_S = 60.0
_MORE = 100  # frames: the samples of the last cycle may come after its point


def response_test() -> dict[str, Any]:
    """Thirteen stepped sines, nothing left out."""
    block = {
        "kind": "frequency_response",
        "amplitudes_n": [2000],
        "frequencies_hz": FREQUENCIES_HZ,
        "measure_cycles": CYCLES,
    }
    return {"schema": 1, "name": "Live response", "blocks": [block]}


class Client:
    """Reads the stream: when each whole point came, and which tick of the program was when."""

    def __init__(self) -> None:
        self.came_s: dict[float, float] = {}
        self._offsets_s: list[float] = []  # arrival less the time of the newest tick
        self._ticks: list[np.ndarray] = []
        self._positions: list[np.ndarray] = []

    def hear(self, frame: str | bytes) -> None:
        """A frame, just arrived."""
        now_s = time.monotonic()
        if isinstance(frame, bytes):
            self._hear_samples(frame, now_s)
            return
        told = json.loads(frame)
        if told["type"] == "response" and told["transfer"] == "force":
            point = told["point"]
            if point["cycles"] == CYCLES:
                self.came_s.setdefault(point["frequency_hz"], now_s)

    def _hear_samples(self, frame: bytes, now_s: float) -> None:
        *_, samples, first, _, _ = _HEADER.unpack_from(frame)
        self._ticks.append(first + np.arange(samples))
        self._positions.append(np.frombuffer(frame, "<f4", offset=_HEADER.size))
        self._offsets_s.append(now_s - (first + samples) * RIG.period_s)

    def delays_s(self, definition: Definition) -> list[float]:
        """Of each point, from the tick of its last cycle to its arrival."""
        ticks, positions = np.concatenate(self._ticks), np.concatenate(self._positions)
        clock_s = min(self._offsets_s)  # of the frame that was the least time on its way
        found = []
        for stretch in stretches(definition):
            if stretch.kind is Kind.CYCLES and stretch.sine is not None:
                last = ticks[np.flatnonzero(positions >= stretch.last - 1)[0]]
                came_s = self.came_s[stretch.sine.frequency_hz]
                found.append(came_s - (clock_s + float(last) * RIG.period_s))
        return found


def listen() -> list[float]:
    """Run the test on a console of its own and listen to it."""
    client = Client()
    with tempfile.TemporaryDirectory() as folder, console(folder) as api:
        make_ready(api)
        saved = api.post("/tests", json={"definition": response_test()}).raise_for_status().json()
        address = str(api.base_url).replace("http", "ws", 1) + "live"
        credentials = {"Authorization": api.headers["Authorization"]}
        with connect(address, additional_headers=credentials) as stream:
            wanted = {"type": "subscribe", "subscription": 1, "channels": ["program_tick"]}
            stream.send(json.dumps(wanted))
            asked = {"test_id": saved["id"], "override_reason": "Benchmark"}
            api.post("/runs", json=asked).raise_for_status()
            give_up = time.monotonic() + _WAIT_S
            while len(client.came_s) < len(FREQUENCIES_HZ) and time.monotonic() < give_up:
                client.hear(stream.recv(_WAIT_S))
            for _ in range(_MORE):
                client.hear(stream.recv(_WAIT_S))
    return client.delays_s(Definition.model_validate(response_test()))


def main(as_json: bool) -> int:
    """Print the figures; returns the exit code."""
    delays_s = listen()
    figures = [
        Figure("points", "Points that came while the test ran", len(delays_s), ""),
        Figure(
            "median_s",
            "From the last cycle of a point to the client",
            float(np.median(delays_s)),
            "s",
        ),
        Figure("most_s", "The same, the slowest", max(delays_s), "s", at_most=AT_MOST_S),
    ]
    note = "the clock of the ticks is that of the quickest frame of samples: up to 1/30 s more"
    show("live_response", figures, [note], as_json)
    return int(any(figure.met is False for figure in figures))
