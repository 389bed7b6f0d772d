"""A hundred browsers and one that has stalled: what each of them gets, and what the loop and Stop feel of it."""

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from statistics import median
from typing import Any

import httpx2
import numpy as np

from bench.a_console import console, make_ready, memory_bytes, start, status
from bench.report import Figure, progress, show

CLIENTS = 100
SECONDS = 40.0
STOPS = 40
NO_CLIENT_S = 15.0


@contextmanager
def many(api: httpx2.Client, clients: int, seconds: float) -> Iterator[subprocess.Popen[str]]:
    """So many clients in a process of their own, all of them watching."""
    url = str(api.base_url).replace("http", "ws").rstrip("/") + "/live"
    token = api.headers["Authorization"].removeprefix("Bearer ")
    process = subprocess.Popen(
        [sys.executable, "-m", "bench.many_clients", url, token, str(clients), str(seconds)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stderr is not None
        if process.stderr.readline().strip() != "watching":
            raise RuntimeError(f"the clients did not get in: {process.communicate()[1]}")
        yield process
    finally:
        if process.poll() is None:
            process.kill()
        process.wait()


class TickTimes:
    """How long the ticks of a stretch took, from the loop's own histogram."""

    def __init__(self, api: httpx2.Client) -> None:
        self._api = api
        self._before = self._counts()

    def _counts(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        histogram = self._api.get("/system/loop").raise_for_status().json()["tick_time"]
        self.bin_s = float(histogram["bin_s"])
        return np.asarray(histogram["counts"], np.int64)

    def p99_s(self) -> float:
        """99 of 100 ticks since this was made took no longer."""
        counts = self._counts() - self._before
        return float(np.searchsorted(np.cumsum(counts), 0.99 * counts.sum()) + 1) * self.bin_s


def stop_times_s(api: httpx2.Client, url: str, body: dict[str, str] | None) -> list[float]:
    """From the request to the loop's own answer, which comes back in it."""
    taken = []
    for _ in range(STOPS):
        begun = time.perf_counter()
        answer = api.post(url, json=body) if body else api.post(url)
        taken.append(time.perf_counter() - begun)
        answer.raise_for_status()
        time.sleep(0.05)
    return taken


def measure() -> list[Figure]:
    """All figures, on a console of its own with a test under way."""
    with tempfile.TemporaryDirectory(prefix="forcerig-bench-") as folder, console(folder) as api:
        make_ready(api)
        start(api, 600.0)
        app = int(api.headers["X-Process"])
        alone = TickTimes(api)
        time.sleep(NO_CLIENT_S)
        p99_alone_s, before_bytes = alone.p99_s(), memory_bytes(app)
        with many(api, CLIENTS, SECONDS) as clients:
            progress(f"{CLIENTS} clients and one that has stalled are watching")
            crowded = TickTimes(api)
            time.sleep(SECONDS / 4)
            early_bytes = memory_bytes(app)
            time.sleep(SECONDS / 4)
            late_bytes = memory_bytes(app)  # before the Stops: a run that ends is measured, too
            stops = stop_times_s(api, "/rig/commands", {"command": "stop"})
            own = stop_times_s(api, status(api)["stop_url"], None)
            p99_crowded_s = crowded.p99_s()
            seen = json.loads(clients.communicate()[0])["clients"]
        shares = [one["ticks"] / max(1, one["last"] - one["first"]) for one in seen]
        rates = [(one["last"] - one["first"]) / SECONDS for one in seen]
        return [
            Figure("clients", "browsers that keep up, beside one that has stalled", len(seen), ""),
            Figure("least_share", "share of all ticks that the worst of them got", min(shares), "", at_least=0.95),
            Figure("median_share", "the median of them", median(shares), ""),
            Figure("rate_hz", "ticks a second that the median saw go by", median(rates), "Hz"),
            Figure("memory_grown_b", "what the app's own memory grew by", late_bytes - before_bytes, "B"),
            Figure("memory_later_b", "of it, in the later 10 s", late_bytes - early_bytes, "B", at_most=5e6),
            Figure("tick_p99_alone_s", "tick, 99 of 100, without a client", p99_alone_s, "s"),
            Figure("tick_p99_ratio", "with the clients", p99_crowded_s / p99_alone_s, "×", at_most=1.25),
            Figure("stop_median_s", "Stop to the loop's answer, as a command", median(stops), "s", at_most=0.020),
            Figure("stop_own_median_s", "Stop on its own path", median(own), "s", at_most=0.020),
            Figure("stop_worst_s", "the slowest of them all", max(stops + own), "s"),
        ]  # fmt: skip


def main(as_json: bool) -> int:
    """Print the figures; exit code 0."""
    notes = [
        f"Clients and console share the processors; each takes five channels of every tick for {SECONDS:g} s.",
        "The loop's answer comes back in the answer to Stop: the way to the loop alone is shorter.",
    ]
    show("clients", measure(), notes, as_json)
    return 0
