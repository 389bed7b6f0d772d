"""The interlocks over REST, with a real loop: looked at, checked, changed by whoever may, and restored."""

from typing import Any

import httpx2
import pytest

from app.access.principal import Role
from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]


def in_force(console: ConsoleProcess) -> dict[str, Any]:
    found: dict[str, Any] = console.http.get("/interlocks").json()
    return found


def changed(now: dict[str, Any], name: str, **changes: Any) -> dict[str, Any]:
    """A request for the table in force with one detector changed."""
    detectors = [d | changes if d["name"] == name else d for d in now["detectors"]]
    return {
        "detectors": detectors,
        "knowingly_weaker": now["knowingly_weaker"],
        "why": "Softer unit",
        "based_on": now["revision"],
    }


def refused(answer: httpx2.Response) -> tuple[int, str]:
    assert answer.headers["content-type"] == "application/problem+json"
    return answer.status_code, answer.json()["code"]


def test_a_change_reaches_the_loop_and_an_old_revision_comes_back(console: ConsoleProcess) -> None:
    console.take_command()
    before = in_force(console)
    assert before["in_loop"]
    made = console.http.put("/interlocks", json=changed(before, "displacement", threshold=0.02))
    assert made.status_code == 200, made.text
    after = made.json()
    assert (after["revision"], after["why"]) == (before["revision"] + 1, "Softer unit")
    assert after["in_loop"]
    assert console.status()["limits"]["displacement_m"] == 0.02
    numbers = {"from": before["revision"], "to": after["revision"]}
    difference = console.http.get("/interlocks/difference", params=numbers).json()
    assert [(d["detector"], d["lines"]) for d in difference["detectors"]] == [
        ("displacement", ["limit: limit 20.0 mm, was limit 32.0 mm"])
    ]
    old = console.http.get(f"/interlocks/revisions/{before['revision']}").json()
    again = {
        "detectors": old["detectors"],
        "knowingly_weaker": old["knowingly_weaker"],
        "why": "As it was",
        "based_on": after["revision"],
    }
    assert console.http.put("/interlocks", json=again).is_success
    assert console.status()["limits"]["displacement_m"] == 0.032
    listed = console.http.get("/interlocks/revisions").json()
    assert [row["why"] for row in listed[:2]] == ["As it was", "Softer unit"]


def test_what_is_wrong_is_told_by_its_path_and_changes_nothing(console: ConsoleProcess) -> None:
    console.take_command()
    now = in_force(console)
    wild = changed(now, "force", threshold=61e3, latching=False)
    answer = console.http.put("/interlocks", json=wild)
    assert refused(answer) == (422, "invalid_request")
    place = [d["name"] for d in now["detectors"]].index("force")
    assert [e["path"] for e in answer.json()["errors"]] == [
        f"detectors[{place}].latching",
        f"detectors[{place}].threshold",
    ]
    weak = changed(now, "app_silence", enabled=False)
    assert refused(console.http.put("/interlocks", json=weak)) == (409, "interlocks_weakened")
    stale = changed(now, "displacement", threshold=0.02) | {"based_on": now["revision"] - 1}
    assert refused(console.http.put("/interlocks", json=stale)) == (409, "edit_conflict")
    assert in_force(console) == now


def test_a_check_adopts_nothing(console: ConsoleProcess) -> None:
    now = in_force(console)
    asked = {key: now[key] for key in ("detectors", "knowingly_weaker")}
    fine = console.http.post("/interlocks/check", json=asked).json()
    assert (fine["valid"], fine["errors"], fine["difference"]["detectors"]) == (True, [], [])
    without = {"detectors": [d for d in now["detectors"] if d["name"] != "force"]}
    weak = console.http.post("/interlocks/check", json=without).json()
    assert not weak["valid"]
    assert {w["detector"] for w in weak["weakened"]} == {"force", "deadlines_missed"}
    assert [d["kind"] for d in weak["difference"]["detectors"]] == ["removed"]
    wrong = {"detectors": [{"name": "x"}]}
    assert console.http.post("/interlocks/check", json=wrong).json()["errors"]
    assert in_force(console) == now


def test_only_an_engineer_in_command_changes_them_and_never_during_a_run(
    ready: ConsoleProcess,
) -> None:
    now = in_force(ready)
    body = changed(now, "displacement", threshold=0.02)
    with ready.as_role(Role.OPERATOR) as operator, ready.as_role(Role.ENGINEER) as engineer:
        assert refused(operator.put("/interlocks", json=body)) == (403, "not_allowed")
        assert refused(engineer.put("/interlocks", json=body)) == (409, "lease_held")
        assert operator.get("/interlocks/live").is_success
    run_id = ready.start_run("harmonic-2-kn-50-hz")
    assert refused(ready.http.put("/interlocks", json=body)) == (409, "run_under_way")
    assert ready.command("stop").is_success
    ready.ended_run(run_id)
    assert in_force(ready) == now


def test_a_run_keeps_the_table_that_it_was_made_under(ready: ConsoleProcess) -> None:
    now = in_force(ready)
    body = changed(now, "displacement", text="Look at the stop")
    assert ready.http.put("/interlocks", json=body).is_success
    run_id = ready.start_run("step-2-kn")
    kept = ready.ended_run(run_id)["interlocks"]["detectors"]
    assert next(d for d in kept if d["name"] == "displacement")["text"] == "Look at the stop"


def test_live_values_come_with_margin_and_state(ready: ConsoleProcess) -> None:
    live = ready.http.get("/interlocks/live").json()
    found = {d["name"]: d for d in live["detectors"]}
    assert list(found) == [d["name"] for d in in_force(ready)["detectors"]]
    assert found["force"]["state"] == "content"
    assert found["force"]["margin"] == pytest.approx(55e3 - abs(found["force"]["value"]))
    assert found["hard_wired_chain"]["text"] == "closed"
    assert found["storage"]["value"] < 5.0
