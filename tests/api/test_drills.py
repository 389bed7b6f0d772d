"""Drills over REST: the catalogue, one given, watched, scored and kept; and what is refused."""

from typing import Any

import pytest

from app.access.principal import Role
from rtcore.rig.faults import FAULTS, Fault
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]


def give(console: ConsoleProcess, fault: str, **more: Any) -> Any:
    console.take_command()
    return console.http.post("/drills", json={"fault": fault, **more})


def scored(console: ConsoleProcess, number: int) -> dict[str, Any]:
    """The record of a drill once it has an end."""

    def record() -> dict[str, Any]:
        return dict(console.http.get(f"/drills/records/{number}").json())

    wait_for(lambda: record()["state"] != "under_way", f"the end of drill {number}")
    wait_for(lambda: console.http.get("/drills").json()["under_way"] is None, "room for another")
    return record()


def test_the_catalogue_says_what_follows_and_why_one_cannot_be_given(
    console: ConsoleProcess,
) -> None:
    console.command("shutdown")
    found = console.http.get("/drills").json()
    assert [d["fault"] for d in found["drills"]] == [fault.name.lower() for fault in Fault]
    assert [d["name"] for d in found["drills"]] == [kind.name for kind in FAULTS.values()]
    assert all(d["why_not"] for d in found["drills"])
    assert (found["under_way"], found["injected"]) == (None, {})
    refused = give(console, "chain_open")
    assert (refused.status_code, refused.json()["code"]) == (409, "wrong_mode")


def test_a_drill_is_given_seen_scored_and_kept(ready: ConsoleProcess) -> None:
    answer = give(ready, "chain_open")
    assert answer.status_code == 201, answer.text
    given = answer.json()
    assert (given["state"], given["mode_before"], given["score"]) == ("under_way", "ready", None)
    assert ready.status()["injected"] == ["chain_open"]
    again = give(ready, "chain_open")
    assert (again.status_code, again.json()["code"]) == (409, "busy")

    record = scored(ready, given["id"])
    assert record["state"] == "passed", record["score"]
    assert (record["first_out"], record["reaction_ticks"]) == ("hard_wired_chain", 1)
    assert {e["name"] for e in record["score"]["expectations"]} >= {"first_out", "supply_off"}
    assert ready.status()["injected"] == []
    assert ready.mode() == "tripped"

    window: dict[str, str | float] = {
        "channels": "mode,supply_pressure_pa",
        "from_s": -0.001,
        "to_s": 0.001,
    }
    samples = ready.http.get(f"/drills/records/{given['id']}/samples", params=window).json()
    assert len(samples["time_s"]) == 9  # a tick each
    page = ready.http.get("/drills/records", params={"fault": "chain_open", "limit": 1}).json()
    assert [r["id"] for r in page["records"]] == [given["id"]]
    audit = ready.http.get("/audit", params={"target": f"drill {given['id']}"}).json()
    actions = {row["action"] for row in next(v for v in audit.values() if isinstance(v, list))}
    assert actions == {"drills.give", "drills.end"}


def test_a_drill_in_a_run_is_on_the_run(ready: ConsoleProcess) -> None:
    assert give(ready, "valve_stuck").json()["code"] == "wrong_mode"  # it needs a load
    run_id = ready.start_run("harmonic-2-kn-50-hz")
    wait_for(lambda: (ready.status()["run"] or {}).get("cycle", 0) >= 3, "some cycles")
    given = give(ready, "load_cell_nan").json()
    assert given["run_id"] == run_id
    record = scored(ready, given["id"])
    assert record["state"] == "passed", record["score"]
    run = ready.ended_run(run_id)
    assert run["outcome"] == "tripped"
    assert "drill" in run["tags"]
    events = ready.http.get(f"/runs/{run_id}/events").json()["events"]
    assert ("fault", "load_cell_nan") in {(e["kind"], e["code"]) for e in events}


def test_faults_are_taken_back_at_a_word(ready: ConsoleProcess) -> None:
    given = give(ready, "load_cell_drift").json()
    cleared = ready.http.post("/drills/clear", json={})
    assert cleared.status_code == 200, cleared.text
    assert cleared.json()["injected"] == {}
    record = scored(ready, given["id"])
    assert record["state"] == "interrupted"
    assert "took the fault back" in record["why"]
    assert ready.mode() == "ready"


@pytest.mark.parametrize(
    ("body", "path"),
    [
        ({"fault": "earthquake"}, "fault"),
        ({"fault": "load_cell_noise", "amount": 0.5}, "amount"),
        ({"fault": "load_cell_open", "amount": 0.0}, "amount"),
    ],
)
def test_what_is_not_in_the_table_is_refused(
    ready: ConsoleProcess, body: dict[str, Any], path: str
) -> None:
    answer = give(ready, **body)
    assert answer.status_code == 422
    assert [e["path"] for e in answer.json()["errors"]] == [path]


def test_drills_need_an_engineer_and_the_lease(ready: ConsoleProcess) -> None:
    operator = ready.as_role(Role.OPERATOR)
    assert operator.get("/drills").status_code == 200
    for path, body in (("/drills", {"fault": "chain_open"}), ("/drills/clear", {})):
        assert operator.post(path, json=body).json()["code"] == "not_allowed"
        engineer = ready.as_role(Role.ENGINEER)
        assert engineer.post(path, json=body).json()["code"] in ("lease_held", "lease_needed")
    assert ready.status()["injected"] == []
    assert ready.http.get("/drills/records/999999").json()["code"] == "unknown_drill"
