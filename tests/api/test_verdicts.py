"""Live runs get their verdict when they end: measured, judged, and told over REST."""

from typing import Any

import pytest

from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
ALSO: list[dict[str, Any]] = [
    {"kind": "timed", "rate_hz": 50},
    {"kind": "peak_valley"},
    {"kind": "max_min", "every_s": 0.2},
    {"kind": "logarithmic_cycles"},
]


def _saved(console: ConsoleProcess, name: str, *acceptance: dict[str, Any]) -> str:
    """A test of 24 cycles at 20 Hz with these criteria; its id."""
    sine = {"kind": "harmonic", "amplitude_n": 1500, "frequency_hz": 20, "cycles": 24}
    definition = {
        "schema": 1,
        "name": name,
        "blocks": [{"kind": "hold", "force_n": 0, "duration_s": 0.1}, sine],
        "record": {"also": ALSO},
        "acceptance": list(acceptance),
    }
    answer = console.http.post("/tests", json={"definition": definition})
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


def _measurements(console: ConsoleProcess, run_id: int) -> Any:
    answer = console.http.get(f"/runs/{run_id}/measurements")
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_a_run_within_its_limits_passes(ready: ConsoleProcess) -> None:
    test_id = _saved(
        ready,
        "Within its limits",
        {"measurement": "amplitude_error_percent", "block": 1, "at_least": -30, "at_most": 30},
        {"measurement": "cycles", "at_least": 24, "at_most": 24},
    )
    run_id = ready.start_run(test_id)
    run = ready.ended_run(run_id)
    assert (run["outcome"], run["verdict"], run["reason"]) == ("completed", "pass", None)
    found = _measurements(ready, run_id)
    assert found["verdict"] == "pass"
    assert [c["outcome"] for c in found["criteria"]] == ["pass", "pass"]
    assert [(b["block"], b["kind"]) for b in found["blocks"]] == [(0, "hold"), (1, "harmonic")]
    values = {m["name"]: m for m in found["run"]}
    assert values["cycles"] == {"name": "cycles", "unit": "1", "value": 24}
    assert values["amplitude_n"]["value"] == pytest.approx(1500, rel=0.3)
    assert values["amplitude_n"]["unit"] == "N"


def test_a_run_beyond_a_limit_fails(ready: ConsoleProcess) -> None:
    criterion = {"measurement": "force_error_rms_n", "block": 1, "at_most": 0.001}
    start = {"test_id": _saved(ready, "Beyond a limit", criterion), "override_reason": "to see"}
    answer = ready.http.post("/runs", json=start)  # the prediction knows that it will fail
    assert answer.status_code == 201, answer.text
    run_id = answer.json()["id"]
    run = ready.ended_run(run_id)
    assert (run["outcome"], run["verdict"]) == ("completed", "fail")
    [judged] = _measurements(ready, run_id)["criteria"]
    assert judged["value"] > 0.001
    assert judged | {"value": 0} == {
        "measurement": "force_error_rms_n",
        "block": 1,
        "unit": "N",
        "value": 0,
        "at_least": None,
        "at_most": 0.001,
        "outcome": "fail",
    }


def test_a_run_that_was_stopped_does_not_pass(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(_saved(ready, "Stopped", {"measurement": "cycles", "at_least": 24}))
    wait_for(lambda: ready.status()["run"]["cycle"] >= 2, "the second cycle")
    assert ready.command("stop").is_success
    run = ready.ended_run(run_id)
    assert (run["outcome"], run["verdict"]) == ("stopped", "unset")
    [judged] = _measurements(ready, run_id)["criteria"]
    assert 2 <= judged["value"] < 24


def test_acquisitions_are_listed_and_served(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(_saved(ready, "Acquired"))
    under_way = ready.http.get(f"/runs/{run_id}/acquisitions")
    assert [table["kind"] for table in under_way.json()] == [also["kind"] for also in ALSO]
    run = ready.ended_run(run_id)
    tables = ready.http.get(f"/runs/{run_id}/acquisitions").json()
    assert tables[0]["rows"] == (run["ticks"] - 1) // 80 + 1
    assert tables[1]["rows"] == 24
    assert tables[1]["columns"][3] == {"name": "peak_force_n", "unit": "N"}
    cycles = ready.http.get(f"/runs/{run_id}/acquisitions/1?from_row=20").json()
    assert (cycles["from_row"], cycles["rows"]) == (20, 24)
    assert cycles["columns"]["cycle"] == [21, 22, 23, 24]
    text = ready.http.get(f"/runs/{run_id}/acquisitions/1.csv")
    assert text.headers["content-type"].startswith("text/csv")
    lines = text.text.splitlines()
    assert lines[0].split(",")[:4] == ["block [1]", "cycle [1]", "whole [1]", "peak_force_n [N]"]
    assert len(lines) == 25


def test_what_is_not_there_is_refused(console: ConsoleProcess) -> None:
    for path in ("measurements", "acquisitions", "acquisitions/0", "acquisitions/0.csv"):
        answer = console.http.get(f"/runs/999999/{path}")
        assert answer.status_code == 404, path
        assert answer.json()["code"] == "unknown_run"
