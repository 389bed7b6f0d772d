"""A start is held against its prediction: clear starts, a caution needs a reason, refused never does."""

from collections.abc import Iterator
from contextlib import closing
from typing import Any

import pyarrow.parquet as pq
import pytest
from sqlalchemy import text

from app.db import Database
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]

CLEAR = {"kind": "hold", "force_n": 1000, "duration_s": 0.3}
# At 30 Hz the closed loop gives 40 % more than what it is asked for.
CAUTION = {"kind": "harmonic", "amplitude_n": 3000, "frequency_hz": 30, "cycles": 10}
REFUSED = {"kind": "harmonic", "amplitude_n": 49_000, "frequency_hz": 60, "cycles": 10}


def _definition(name: str, block: dict[str, Any]) -> dict[str, Any]:
    return {"schema": 1, "name": name, "blocks": [block]}


@pytest.fixture(scope="module")
def tests(console: ConsoleProcess) -> dict[str, str]:
    ids = {}
    for name, block in (("clear", CLEAR), ("caution", CAUTION), ("refused", REFUSED)):
        answer = console.http.post("/tests", json=_definition(f"Start {name}", block))
        assert answer.status_code == 201, answer.text
        ids[name] = answer.json()["id"]
    return ids


def _rows(console: ConsoleProcess) -> dict[str, int]:
    database = Database(console.database_url)
    with closing(database), database.reading() as session:
        return {
            table: session.execute(text(f"SELECT count(*) FROM {table}")).scalar_one()
            for table in ("runs", "documents", "run_tags")
        }


def _left(console: ConsoleProcess) -> tuple[dict[str, int], list[str]]:
    return _rows(console), sorted(p.name for p in (console.data / "runs").iterdir())


@pytest.fixture
def nothing_left(ready: ConsoleProcess) -> Iterator[None]:
    before = _left(ready)
    yield
    assert _left(ready) == before


def _predicted(console: ConsoleProcess, path: str, body: dict[str, Any]) -> dict[str, Any]:
    def asked() -> Any:
        answer = console.http.post(path, json=body | {"wait_s": 10})
        assert answer.status_code in (200, 202), answer.text
        return answer.json() if answer.status_code == 200 else None

    found: dict[str, Any] = wait_for(asked, "the prediction")
    return found


def test_a_prediction_says_what_stands_against_a_test(
    console: ConsoleProcess, tests: dict[str, str]
) -> None:
    for name, test_id in tests.items():
        found = _predicted(console, f"/tests/{test_id}/prediction", {})
        assert found["verdict"] == name
        assert bool(found["reasons"]) == (name != "clear")
        assert {m["detector"] for m in found["margins"]} >= {"force", "supply_pressure"}


def test_a_test_that_is_not_saved_is_predicted_alike(
    console: ConsoleProcess, tests: dict[str, str]
) -> None:
    saved = _predicted(console, f"/tests/{tests['clear']}/prediction", {})
    text = _predicted(
        console, "/tests/prediction", {"definition": _definition("Start clear", CLEAR)}
    )
    assert text == saved  # the very same computation
    wrong = console.http.post("/tests/prediction", json={"yaml": "schema: 1"})
    assert wrong.status_code == 422
    missing = console.http.post("/tests/nowhere/prediction")
    assert missing.status_code == 404


@pytest.mark.usefixtures("nothing_left")
def test_what_is_refused_never_starts_whatever_the_reason(
    ready: ConsoleProcess, tests: dict[str, str]
) -> None:
    _predicted(ready, f"/tests/{tests['refused']}/prediction", {})
    body = {"test_id": tests["refused"], "override_reason": "I know better", "tags": ["x"]}
    answer = ready.http.post("/runs", json=body)
    assert (answer.status_code, answer.json()["code"]) == (409, "prediction_refused")
    assert "interlock" in answer.json()["detail"]
    assert answer.json()["prediction"]["verdict"] == "refused"
    assert answer.json()["prediction"]["reasons"][0]["code"] == "detector_trips"
    assert ready.mode() == "ready"


@pytest.mark.usefixtures("nothing_left")
def test_a_caution_does_not_start_without_a_reason(
    ready: ConsoleProcess, tests: dict[str, str]
) -> None:
    _predicted(ready, f"/tests/{tests['caution']}/prediction", {})
    for reason in (None, "  "):
        answer = ready.http.post(
            "/runs", json={"test_id": tests["caution"], "override_reason": reason}
        )
        assert (answer.status_code, answer.json()["code"]) == (409, "override_needed")
        assert "amplitude" in answer.json()["detail"]


def test_a_caution_starts_with_a_reason_which_the_run_keeps(
    ready: ConsoleProcess, tests: dict[str, str]
) -> None:
    predicted = _predicted(ready, f"/tests/{tests['caution']}/prediction", {})
    body = {
        "test_id": tests["caution"],
        "revision": 1,
        "override_reason": "The overshoot is what is looked for",
        "operator": "Ada",
        "notes": "first of the day",
        "tags": ["tuning"],
    }
    answer = ready.http.post("/runs", json=body)
    assert answer.status_code == 201, answer.text
    run = ready.ended_run(answer.json()["id"])
    assert run["outcome"] == "completed"
    assert run["revision"] == 1
    assert run["prediction_verdict"] == "caution"
    assert run["override_reason"] == "The overshoot is what is looked for"
    assert (run["operator"], run["notes"], run["tags"]) == ("Ada", "first of the day", ["tuning"])

    series = pq.read_table(ready.data / "runs" / str(run["id"]) / "predicted.parquet")
    assert series.column_names == ["program_tick", "force_n", "displacement_m"]
    peak_n = abs(series["force_n"].to_numpy()).max()
    assert peak_n == pytest.approx(predicted["peaks"]["force_n"], rel=1e-6)
    kept = ready.http.get(f"/runs/{run['id']}/prediction").json()
    assert kept == predicted
    bands = ready.http.get(f"/runs/{run['id']}/predicted", params={"points": 50}).json()
    assert max(bands["force_max_n"]) == pytest.approx(series["force_n"].to_numpy().max())
    assert len(bands["time_s"]) <= 50
    recorded = pq.read_table(ready.data / "runs" / str(run["id"]) / "run.parquet")
    assert abs(recorded["force_n"].to_numpy()).max() == pytest.approx(peak_n, rel=0.01)


def test_a_clear_test_starts_by_itself_and_a_reason_is_not_kept(
    ready: ConsoleProcess, tests: dict[str, str]
) -> None:
    _predicted(ready, f"/tests/{tests['clear']}/prediction", {})
    body = {"test_id": tests["clear"], "override_reason": "none needed"}
    answer = ready.http.post("/runs", json=body)
    assert answer.status_code == 201, answer.text
    run = ready.ended_run(answer.json()["id"])
    assert (run["prediction_verdict"], run["override_reason"]) == ("clear", None)


@pytest.mark.usefixtures("nothing_left")
def test_a_test_or_revision_that_is_not_there_is_not_started(
    ready: ConsoleProcess, tests: dict[str, str]
) -> None:
    answer = ready.http.post("/runs", json={"test_id": "nowhere"})
    assert (answer.status_code, answer.json()["code"]) == (404, "unknown_test")
    answer = ready.http.post("/runs", json={"test_id": tests["clear"], "revision": 99})
    assert (answer.status_code, answer.json()["code"]) == (404, "unknown_revision")


def test_a_held_run_shows_what_resume_will_do(ready: ConsoleProcess) -> None:
    assert ready.http.get("/rig/resume").status_code == 409
    block = {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 5, "cycles": 100}
    made = ready.http.post("/tests", json=_definition("Held and resumed", block)).json()["id"]
    _predicted(ready, f"/tests/{made}/prediction", {})
    run_id = ready.start_run(made)
    wait_for(lambda: (ready.status()["run"] or {}).get("cycle", 0) >= 1, "a counted cycle")
    assert not {p["name"]: p["met"] for p in ready.status()["permissives"]}["idle"]
    assert ready.command("hold").is_success
    wait_for(lambda: ready.mode() == "holding", "the hold")
    shown = ready.http.get("/rig/resume").json()
    assert max(shown["force_max_n"]) == pytest.approx(2000, rel=0.01)
    assert shown["block"] == 0
    assert shown["cycle"] >= 1
    assert "block 1 goes on" in shown["text"]
    assert ready.command("resume").is_success
    assert ready.command("stop").is_success
    ready.ended_run(run_id)
