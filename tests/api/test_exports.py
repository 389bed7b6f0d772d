"""Exports over the interface: streamed, or as jobs with a file; and the metrics of the console that made them."""

import io
from typing import Any

import h5py
import httpx2
import numpy as np
import pyarrow.parquet as pq
import pytest
import scipy.io
from nptdms import TdmsFile
from prometheus_client.parser import text_string_to_metric_families

from app.access.principal import Role
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
STEP = "step-2-kn"
WINDOW = {"channels": "force_n,tick", "from_s": "0.5", "to_s": "1.25"}


@pytest.fixture(scope="module")
def run_id(console: ConsoleProcess) -> int:
    console.make_ready()
    found = console.start_run(STEP)
    console.ended_run(found)
    return found


@pytest.fixture(scope="module")
def forces(console: ConsoleProcess, run_id: int) -> np.ndarray:
    """The recorded forces of the window, from the run's own file."""
    table = pq.read_table(console.data / "runs" / str(run_id) / "run.parquet")
    ticks = table["tick"].to_numpy() - table["tick"][0].as_py()
    return np.asarray(table["force_n"].to_numpy()[(ticks >= 2000) & (ticks <= 5000)])


def fetched(console: ConsoleProcess, path: str, **query: str) -> bytes:
    answer = console.http.get(path, params=query)
    assert answer.status_code == 200, answer.text
    return answer.content


def mat_force(file: Any) -> np.ndarray:
    return np.asarray(scipy.io.loadmat(file)["force_n"][:, 0])


def test_each_format_is_fetched_with_channels_and_window(
    console: ConsoleProcess, run_id: int, forces: np.ndarray
) -> None:
    def data(ending: str) -> io.BytesIO:
        return io.BytesIO(fetched(console, f"/runs/{run_id}/data.{ending}", **WINDOW))

    lines = [line for line in data("csv").getvalue().decode().splitlines() if line[0] != "#"]
    assert lines[0] == "tick [1],time_s [s],force_n [N]"
    with h5py.File(data("h5")) as file:
        h5 = file["force_n"][:]
    found = {
        "parquet": pq.read_table(data("parquet"))["force_n"].to_numpy(),
        "csv": np.array([line.split(",")[2] for line in lines[1:]], np.float32),
        "mat": mat_force(data("mat")),
        "tdms": TdmsFile.read(data("tdms"))["recording"]["force_n"][:],
        "h5": h5,
    }
    for ending, values in found.items():
        assert np.array_equal(values, forces), ending


def test_what_is_asked_wrongly_is_refused_before_a_byte_is_sent(
    console: ConsoleProcess, run_id: int
) -> None:
    def refused(path: str, **query: str) -> tuple[int, str]:
        answer = console.http.get(path, params=query)
        return answer.status_code, answer.json()["code"]

    assert refused(f"/runs/{run_id}/data.csv", channels="forc") == (422, "unknown_channel")
    assert refused(f"/runs/{run_id}/data.mat", from_s="900") == (422, "invalid_request")
    assert refused(f"/runs/{run_id}/data.xlsx")[0] == 422
    assert refused("/runs/999999/data.csv") == (404, "unknown_run")


def test_a_job_makes_a_file_and_tells_how_far_it_is(
    console: ConsoleProcess, run_id: int, forces: np.ndarray
) -> None:
    with console.as_role(Role.VIEWER) as viewer:
        wish = {"format": "mat", "channels": ["force_n"], "from_s": 0.5, "to_s": 1.25}
        made = viewer.post(f"/runs/{run_id}/exports", json=wish)
        assert made.status_code == 202, made.text
        path = f"/runs/{run_id}/exports/{made.json()['id']}"
        done = wait_for(lambda: _ended(viewer, path), "the export")
        assert (done["state"], done["share"]) == ("done", 1.0)
        assert done["channels"] == ["time_s", "force_n"]
        content = fetched(console, f"{path}/file")
        assert len(content) == done["size_bytes"]
        assert np.array_equal(mat_force(io.BytesIO(content)), forces)
        assert [one["id"] for one in viewer.get(f"/runs/{run_id}/exports").json()] == [done["id"]]
        assert viewer.delete(path).status_code == 200
        assert viewer.get(path).json()["code"] == "not_found"
    assert list((console.data / "exports").iterdir()) == []


def _ended(client: httpx2.Client, path: str) -> dict[str, object] | None:
    found: dict[str, object] = client.get(path).json()
    return found if found["state"] in ("done", "failed", "cancelled") else None


def test_metrics_are_told_to_who_may_read(console: ConsoleProcess, run_id: int) -> None:
    with console.client() as stranger:
        assert stranger.get(f"{console.url}/metrics").status_code == 401
    with console.as_role(Role.VIEWER) as viewer:
        answer = viewer.get(f"{console.url}/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=")
    samples = {
        (sample.name, *sample.labels.values()): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }
    assert samples["forcerig_mode", "ready"] == 1
    assert samples["forcerig_mode", "running"] == 0
    assert abs(samples["forcerig_force_newtons",]) < 500
    assert samples["forcerig_loop_alive",] == 1
    assert samples["forcerig_loop_ticks_total",] > 8000
    wakeups = samples["forcerig_loop_wakeup_latency_seconds_count",]
    assert wakeups >= samples["forcerig_loop_ticks_total",]
    assert samples["forcerig_loop_wakeup_latency_seconds_bucket", "+Inf"] == wakeups
    assert samples["forcerig_runs", "completed"] >= 1
    assert samples["forcerig_memory_bytes", "console"] > 50e6
    assert samples["forcerig_disk_free_bytes",] > 0
    assert not any(name[0].startswith(("python_", "process_")) for name in samples)
