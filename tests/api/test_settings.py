"""Controller and rig configuration over REST, with a real loop: changed, refused, tried, analysed, brought back."""

from typing import Any

import httpx2
import pytest

from app.access.principal import Role
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]


def in_force(console: ConsoleProcess, what: str) -> dict[str, Any]:
    found: dict[str, Any] = console.http.get(f"/{what}").json()
    return found


def change(now: dict[str, Any], **values: Any) -> dict[str, Any]:
    """A request for what is in force with some values changed."""
    return {
        "document": now["document"] | values,
        "why": "Softer unit",
        "based_on": now["revision"],
    }


def refused(answer: httpx2.Response) -> tuple[int, str]:
    assert answer.headers["content-type"] == "application/problem+json"
    return answer.status_code, answer.json()["code"]


def test_a_controller_reaches_the_loop_the_audit_and_the_run_and_an_old_one_comes_back(
    ready: ConsoleProcess,
) -> None:
    now = in_force(ready, "controller")
    assert now["in_loop"]
    made = ready.http.put("/controller", json=change(now, k_p=9e-6))
    assert made.status_code == 200, made.text
    after = made.json()
    assert (after["revision"], after["in_loop"]) == (now["revision"] + 1, True)
    numbers = {"from": now["revision"], "to": after["revision"]}
    differs = ready.http.get("/controller/difference", params=numbers).json()["changes"]
    assert [(d["path"], d["before"], d["after"]) for d in differs] == [("k_p", 1.19e-5, 9e-6)]
    run_id = ready.start_run("step-2-kn")
    stale = change(after, k_p=8e-6)
    assert refused(ready.http.put("/controller", json=stale)) == (409, "run_under_way")
    assert ready.ended_run(run_id)["controller"]["k_p"] == 9e-6
    body = {"why": "As it was", "based_on": after["revision"]}
    back = ready.http.post(f"/controller/revisions/{now['revision']}/restore", json=body)
    assert back.json()["document"] == now["document"]
    listed = ready.http.get("/controller/revisions").json()
    assert [row["why"] for row in listed[:2]] == ["As it was", "Softer unit"]
    noted = ready.http.get("/audit", params={"action": "controller.change"}).json()["entries"]
    assert [entry["why"] for entry in noted[:2]] == ["As it was", "Softer unit"]


def test_what_is_wrong_is_told_by_its_path_and_changes_nothing(console: ConsoleProcess) -> None:
    console.take_command()
    now = in_force(console, "controller")
    wrong = change(now, k_p=-1.0, k_q=1.0)
    answer = console.http.put("/controller", json=wrong)
    assert refused(answer) == (422, "invalid_request")
    assert {e["path"] for e in answer.json()["errors"]} == {"k_p", "k_q"}
    conflict = change(now, k_p=9e-6) | {"based_on": now["revision"] + 7}
    assert refused(console.http.put("/controller", json=conflict)) == (409, "edit_conflict")
    with console.as_role(Role.OPERATOR) as operator, console.as_role(Role.ENGINEER) as engineer:
        body = change(now, k_p=9e-6)
        assert refused(operator.put("/controller", json=body)) == (403, "not_allowed")
        assert refused(engineer.put("/controller", json=body)) == (409, "lease_held")
    assert in_force(console, "controller") == now


def test_a_model_comes_into_force_without_pressure_only_the_rest_at_any_time(
    ready: ConsoleProcess,
) -> None:
    now = in_force(ready, "rig-configuration")
    assert now["in_loop"]
    softer = {"structure": now["document"]["model"]["structure"] | {"k_pl": 149e6}}
    body = change(now, model=now["document"]["model"] | softer)
    assert refused(ready.http.put("/rig-configuration", json=body)) == (409, "wrong_mode")
    cell = {"gain": 6e3, "calibrated_on": "2020-01-01", "due_on": "2021-01-01"}
    calibrations = now["document"]["calibrations"] | {"load_cell": cell}
    told = ready.http.put("/rig-configuration", json=change(now, calibrations=calibrations)).json()
    assert told["calibrations"][0]["text"] == "overdue since 2021-01-01"
    run_id = ready.start_run("step-2-kn")
    kept = ready.ended_run(run_id)["rig"]
    assert kept["configuration"]["revision"] == told["revision"]
    assert kept["configuration"]["calibrations"]["load_cell"]["due_on"] == "2021-01-01"
    assert ready.command("depressurise").is_success
    body = change(told, model=now["document"]["model"] | softer)
    made = ready.http.put("/rig-configuration", json=body).json()
    assert made["in_loop"]
    assert made["document"]["model"]["structure"]["k_pl"] == 149e6
    body = {"why": "As it was", "based_on": made["revision"]}
    back = ready.http.post(f"/rig-configuration/revisions/{now['revision']}/restore", json=body)
    assert back.json()["document"] == now["document"]
    assert back.json()["in_loop"]


def test_the_labs_limit_stands_against_a_start(ready: ConsoleProcess) -> None:
    now = in_force(ready, "rig-configuration")
    limited = ready.http.put("/rig-configuration", json=change(now, limits={"force_n": 1000}))
    answer = ready.http.post("/runs", json={"test_id": "step-2-kn"})
    assert refused(answer) == (422, "invalid_test")
    assert "allows 1,000 N" in answer.json()["detail"]
    body = {"why": "As it was", "based_on": limited.json()["revision"]}
    path = f"/rig-configuration/revisions/{now['revision']}/restore"
    assert ready.http.post(path, json=body).is_success


def test_a_draft_is_checked_and_tried_and_nothing_is_adopted(console: ConsoleProcess) -> None:
    now = in_force(console, "controller")
    draft = now["document"] | {"k_p": 6e-6}
    checked = console.http.post("/controller/check", json={"document": draft}).json()
    assert checked["valid"]
    assert [c["path"] for c in checked["difference"]["changes"]] == ["k_p"]
    slower = checked["loop"]["loops"][1]["margins"]
    same = console.http.get("/analysis/linear").json()["loops"][1]["margins"]
    assert slower["gain_margin_db"] > same["gain_margin_db"]
    wrong = console.http.post("/controller/check", json={"document": {"k_q": 1}}).json()
    assert (wrong["valid"], wrong["errors"][0]["path"]) == (False, "k_q")
    job = console.http.post("/controller/preview", json={"document": draft}).json()

    def result() -> Any:
        told = console.http.get(f"/controller/previews/{job['id']}").json()
        assert told["state"] != "failed", told
        return told["result"]

    tried = wait_for(result, "the preview")
    assert (tried["draft"]["revision"], tried["beside"]["revision"]) == (None, now["revision"])
    step = {
        name: {m["name"]: m["value"] for m in tried[name]["measurements"] if m["kind"] == "step"}
        for name in ("draft", "beside")
    }
    assert step["beside"]["step_overshoot_percent"] == pytest.approx(
        22.7, abs=1.5
    )  # the data sheet
    assert step["draft"]["step_overshoot_percent"] != step["beside"]["step_overshoot_percent"]
    assert len(tried["draft"]["time_s"]) == len(tried["draft"]["force_n"]["max"]) > 1000
    assert in_force(console, "controller") == now


def test_the_sheets_are_of_what_is_in_force_or_of_a_revision(console: ConsoleProcess) -> None:
    static: dict[str, Any] = {"orifice_diameter_m": [0.5e-3, 0.85e-3], "points": 11}
    sheet = console.http.get("/analysis/static", params=static).json()
    assert [o["orifice_diameter_m"] for o in sheet["orifices"]] == [0.5e-3, 0.85e-3]
    first = console.http.get("/analysis/linear", params={"controller_revision": 0}).json()
    assert first["loops"][1]["margins"]["crossover_hz"] == pytest.approx(45.6, abs=0.15)
    asked: dict[str, Any] = {"load_hz": 50, "tune_hz": 4, "controller_revision": 0}
    tuning = console.http.get("/analysis/compensator", params=asked).json()["tuning"]
    assert tuning["ff_v"] == pytest.approx(1.9607, rel=1e-4)
    wrongs: list[dict[str, Any]] = [
        {"controller_revision": 999},
        {"amplitude": 5},
        {"from_hz": 5, "to_hz": 5},
    ]
    for wrong in wrongs:
        answer = console.http.get("/analysis/linear", params=wrong)
        assert answer.status_code in (404, 422), wrong
        assert answer.json()["code"] in ("unknown_revision", "invalid_request")
