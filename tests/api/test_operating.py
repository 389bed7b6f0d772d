"""A day at the rig over REST: reset, pressurise, run, stop; and what is refused on the way."""

import sqlite3
import time

import httpx2
import numpy as np
import pyarrow.parquet as pq
import pytest

from app.rigs.schemas import RigStatus
from rtcore.channels import CHANNELS
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
STEP = "step-2-kn"


def problem(answer: httpx2.Response) -> tuple[int, str, str]:
    assert answer.headers["content-type"] == "application/problem+json"
    body = answer.json()
    assert body["status"] == answer.status_code
    assert body["title"]
    return body["status"], body["code"], body["detail"]


def test_a_latched_rig_says_what_to_do(console: ConsoleProcess) -> None:
    assert console.command("shutdown").is_success
    runs = console.http.get("/runs").json()
    status = RigStatus.model_validate(console.status())
    assert status.mode == "tripped"
    assert status.loop.alive
    assert status.commands.reset is None
    assert problem(console.command("pressurise"))[:2] == (409, "wrong_mode")
    assert "Press Reset first" in problem(console.command("pressurise"))[2]
    refused = console.http.post("/runs", json={"test_id": STEP})
    assert problem(refused)[:2] == (409, "wrong_mode")
    assert console.http.get("/runs").json() == runs


def test_a_stop_with_nothing_to_stop_is_done(console: ConsoleProcess) -> None:
    assert console.command("stop").status_code == 200


def test_a_run_from_start_to_file(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(STEP)
    status = ready.status()
    assert status["run"]["id"] == run_id
    assert status["run"]["blocks"] == 3
    assert status["run"]["duration_s"] == ready.http.get(f"/tests/{STEP}").json()["duration_s"]
    under_way = ready.http.get(f"/runs/{run_id}/data.parquet")
    assert problem(under_way)[:2] == (409, "run_under_way")
    refused = ready.http.post("/runs", json={"test_id": STEP})
    assert problem(refused)[1:] == ("wrong_mode", "A test is running")

    run = ready.ended_run(run_id)
    assert (run["outcome"], run["reason"]) == ("completed", None)
    assert run["missing_ticks"] == 0
    assert run["ticks"] == run["last_tick"] - run["first_tick"] + 1
    assert run["definition"]["name"] == run["test_name"] == "Step of 2 kN"
    assert {d["name"] for d in run["interlocks"]["detectors"]} >= {"force", "app_silence"}
    assert run["controller"]["k_p"] > 0
    assert run["rig"]["supply"]["high_pa"] > 0
    assert {c["name"] for c in run["conditions"]} >= {"sched_fifo", "mlockall"}

    answer = ready.http.get(f"/runs/{run_id}/data.parquet")
    path = ready.data / "downloaded.parquet"
    path.write_bytes(answer.content)
    table = pq.read_table(path)
    assert table.schema.names == [channel.name for channel in CHANNELS]
    ticks = table["tick"].to_numpy()
    assert np.array_equal(ticks, np.arange(run["first_tick"], run["last_tick"] + 1))
    assert set(table["run"].to_pylist()) == {run_id}
    held = table["force_n"].to_numpy()[4000:5500].mean()  # well after the step
    assert held == pytest.approx(2000.0, abs=20.0)
    left = {path.name for path in (ready.data / "runs" / str(run_id)).iterdir()}
    assert {"run.parquet", "predicted.parquet"} <= left
    assert not any(name.startswith("part-") for name in left)


def test_events_of_a_run_are_kept_with_their_time_in_it(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(STEP)
    run = ready.ended_run(run_id)
    events = ready.http.get(f"/runs/{run_id}/events").json()["events"]
    kinds = [event["kind"] for event in events if event["kind"] != "deadlines_missed"]
    assert kinds[:3] == ["mode", "block", "command"]
    assert "program_ended" in kinds
    assert events[-1]["code"] == "ready"
    assert [event["time_s"] for event in events] == sorted(event["time_s"] for event in events)
    assert events[0]["tick"] == run["first_tick"]
    assert events[-1]["tick"] == run["last_tick"] + 1


def test_samples_are_the_extremes_of_every_stretch(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(STEP)
    ready.ended_run(run_id)
    table = pq.read_table(ready.data / "runs" / str(run_id) / "run.parquet")
    force = table["force_n"].to_numpy().astype(np.float64)
    asked = {"channels": "force_n,mode", "points": "100"}
    samples = ready.http.get(f"/runs/{run_id}/samples", params=asked).json()
    assert samples["decimated"]
    assert 50 < len(samples["time_s"]) <= 100
    starts = np.round(np.array(samples["time_s"]) / 250e-6).astype(int)
    assert starts[0] == 0
    widths = np.unique(np.diff(starts[1:]))
    assert len(widths) == 1  # all of one width but for the two ends, at multiples of it
    assert not ((table["tick"][0].as_py() + starts[1:]) % widths[0]).any()
    stretches = np.split(force, starts[1:])  # no sample is left out and none counts twice
    assert samples["channels"]["force_n"]["max"] == [stretch.max() for stretch in stretches]
    assert samples["channels"]["force_n"]["min"] == [stretch.min() for stretch in stretches]
    assert max(map(len, stretches)) == widths[0]

    asked |= {"from_s": "0.5", "to_s": "0.51"}
    samples = ready.http.get(f"/runs/{run_id}/samples", params=asked).json()
    assert not samples["decimated"]
    assert samples["time_s"] == pytest.approx(0.5 + np.arange(41) * 250e-6)
    assert samples["channels"]["force_n"]["min"] == force[2000:2041].tolist()
    assert samples["channels"]["force_n"]["max"] == force[2000:2041].tolist()


def test_samples_of_a_run_under_way_grow(ready: ConsoleProcess) -> None:
    run_id = ready.start_run("harmonic-2-kn-50-hz")

    def last_s() -> float:
        answer = ready.http.get(f"/runs/{run_id}/samples", params={"channels": "force_n"})
        return float(answer.json()["to_s"]) if answer.is_success else 0.0

    early_s = wait_for(last_s, "first samples")
    wait_for(lambda: last_s() > early_s + 0.2, "more samples")
    assert ready.run(run_id)["outcome"] is None
    assert ready.command("stop").is_success
    assert ready.ended_run(run_id)["outcome"] == "stopped"


def test_stop_takes_the_load_off_and_the_run_says_so(ready: ConsoleProcess) -> None:
    run_id = ready.start_run("harmonic-2-kn-50-hz")
    wait_for(lambda: ready.status()["run"]["cycle"] > 5, "some cycles")
    assert ready.command("stop").is_success
    run = ready.ended_run(run_id)
    assert (run["outcome"], run["reason"]) == ("stopped", "Stopped by the operator")
    assert ready.mode() == "ready"
    assert abs(ready.status()["readings"]["force_n"]) < 200


def test_hold_and_resume(ready: ConsoleProcess) -> None:
    run_id = ready.start_run("harmonic-2-kn-50-hz")
    assert ready.command("hold").is_success
    assert ready.mode() == "holding"
    assert problem(ready.command("hold"))[1:] == ("wrong_mode", "Already held")
    assert ready.command("resume").is_success
    assert ready.mode() == "running"
    assert ready.command("stop").is_success
    ready.ended_run(run_id)


def test_runs_come_in_pages_newest_first(ready: ConsoleProcess) -> None:
    while len(ready.http.get("/runs").json()["runs"]) < 3:
        run_id = ready.start_run(STEP)
        ready.command("stop")
        ready.ended_run(run_id)
    everything = [run["id"] for run in ready.http.get("/runs").json()["runs"]]
    assert everything == sorted(everything, reverse=True)
    pages, before = [], None
    while True:
        asked = {"limit": 2} | ({} if before is None else {"before": before})
        page = ready.http.get("/runs", params=asked).json()
        pages += [run["id"] for run in page["runs"]]
        before = page["next"]
        if before is None:
            break
    assert pages == everything


def test_the_stop_needs_no_database(ready: ConsoleProcess) -> None:
    run_id = ready.start_run("harmonic-2-kn-50-hz")
    wait_for(lambda: ready.run(run_id)["first_tick"], "its row")
    with sqlite3.connect(ready.data / "forcerig.sqlite", isolation_level=None) as held:
        held.execute("BEGIN EXCLUSIVE")
        began = time.monotonic()
        assert ready.command("stop").is_success
        assert time.monotonic() - began < 14.0  # the database would say no after 15 s
        held.execute("ROLLBACK")
    held.close()
    assert ready.ended_run(run_id)["missing_ticks"] == 0
