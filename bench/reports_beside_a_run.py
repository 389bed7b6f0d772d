"""What reports made during a run cost the loop: its ticks while reports are made, beside those while none is."""

import time
from collections.abc import Iterator
from tempfile import TemporaryDirectory
from typing import Any

import httpx2
import numpy as np
import pyarrow.parquet as pq

from bench.a_console import console, make_ready, status, until
from bench.report import Figure, progress, show

TEST = "flight-spectrum"
SHORT = "step-2-kn"
LASTS_S = 20.0
QUANTILE = 99.9


def figures(lasts_s: float) -> Iterator[Figure]:
    """One run in real time: half of it with reports of another run, one after the other, half without."""
    with TemporaryDirectory(prefix="forcerig-bench-") as folder, console(folder) as api:
        make_ready(api)
        finished = _run(api, SHORT)
        until(lambda: api.get(f"/runs/{finished}").json()["outcome"], "end of a run")
        until(lambda: status(api)["commands"]["start"] is None, "leave to start")
        run_id = _run(api, TEST)
        progress(f"{lasts_s:.0f} s with reports, {lasts_s:.0f} s without")
        began = _tick(api)
        made = _reports(api, finished, lasts_s)
        between = _tick(api)
        time.sleep(lasts_s)
        ended = _tick(api)
        api.post("/rig/commands", json={"command": "stop"}).raise_for_status()
        until(lambda: api.get(f"/runs/{run_id}").json()["outcome"], "end of the run")
        path = f"{folder}/data/runs/{run_id}/run.parquet"
        yield from _told(pq.read_table(path), made, began, between, ended)


def _run(api: httpx2.Client, test: str) -> int:
    answer = api.post("/runs", json={"test_id": test})
    answer.raise_for_status()
    return int(answer.json()["id"])


def _tick(api: httpx2.Client) -> int:
    return int(status(api)["loop"]["tick"])


def _reports(api: httpx2.Client, run_id: int, lasts_s: float) -> int:
    """Whole ones, each made anew: the run has another note each time."""
    give_up, made = time.monotonic() + lasts_s, 0
    while time.monotonic() < give_up:
        noted = {"notes": str(made), "annotation": made}
        api.patch(f"/runs/{run_id}", json=noted).raise_for_status()
        report = api.get(f"/runs/{run_id}/report.pdf")
        if report.is_error:
            raise RuntimeError(report.json()["detail"])
        made += 1
    return made


def _told(table: Any, made: int, began: int, between: int, ended: int) -> Iterator[Figure]:
    ticks = table["tick"].to_numpy()
    lost = float(ticks[-1] - ticks[0] + 1 - len(ticks))
    yield Figure("reports", "reports made", float(made), "", at_least=1)
    yield Figure("lost_ticks", "ticks not recorded", lost, "", at_most=0)
    stretches = ticks >= began, ticks >= between, ticks >= ended
    with_reports, without = stretches[0] & ~stretches[1], stretches[1] & ~stretches[2]
    missed = table["deadlines_missed"].to_numpy()
    for name, what in (("tick_time_s", "tick"), ("wakeup_latency_s", "wake-up")):
        values = table[name].to_numpy()
        for p in (50.0, QUANTILE):
            own = [float(np.percentile(values[part], p)) for part in (with_reports, without)]
            key = f"{name.removesuffix('_s')}_p{p:g}"
            note = f"{own[1] * 1e6:.1f} µs without: {own[0] / own[1]:.2f} ×"
            yield Figure(f"{key}_s", f"{what}, {p:g} %, with reports", own[0], "s", note=note)
    for part, word in ((with_reports, "with"), (without, "without")):
        found = float(np.ptp(missed[part])) if part.any() else 0.0
        yield Figure(f"missed_{word}", f"deadlines missed, {word} reports", found, "")


NOTES = [
    "a report takes a process apart at niceness 15; other work on this machine shows in both halves"
]


def main(as_json: bool, minutes: float = 2 * LASTS_S / 60.0) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    show("reports_beside_a_run", list(figures(minutes * 30.0)), NOTES, as_json)
    return 0
