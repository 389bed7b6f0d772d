"""The audit over HTTP: pages, filters, who may look, and that it is in order."""

import json
from typing import Any

import pytest

from app.access.principal import Role
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
DEFINITION = {"schema": 1, "name": "Audited", "blocks": [{"kind": "hold", "duration_s": 1.0}]}


def entries(console: ConsoleProcess, **sought: object) -> list[dict[str, Any]]:
    answer = console.http.get("/audit", params=sought)  # type: ignore[arg-type]
    assert answer.status_code == 200, answer.text
    return answer.json()["entries"]  # type: ignore[no-any-return]


@pytest.fixture
def audited(console: ConsoleProcess) -> str:
    """A test that was created and given tags five times; its id."""
    made = console.http.post("/tests", json={"definition": DEFINITION, "author": "ada"})
    assert made.status_code == 201, made.text
    test_id: str = made.json()["id"]
    for n in range(5):
        console.http.put(f"/tests/{test_id}/tags", json={"tags": [f"n{n}"]})
    return test_id


def test_pages_go_on_where_the_one_before_ended(console: ConsoleProcess, audited: str) -> None:
    whole = entries(console, target=audited)
    assert [entry["action"] for entry in whole] == ["tests.tag"] * 5 + ["tests.create"]
    found, before = [], None
    while True:
        params = {"target": audited, "limit": "4"} | ({"before": str(before)} if before else {})
        page = console.http.get("/audit", params=params).json()
        found += page["entries"]
        before = page["next"]
        if before is None:
            break
    assert found == whole
    assert found[0]["before"] == ["n3"]
    assert found[0]["after"] == ["n4"]


def test_filters_leave_what_is_sought(console: ConsoleProcess, audited: str) -> None:
    (made,) = entries(console, action="tests.c", target=audited)
    at = made["at"]
    assert {entry["action"] for entry in entries(console, action="tests")} >= {"tests.tag"}
    assert entries(console, action="ests") == []
    assert entries(console, target=audited, until=at) == []
    assert len(entries(console, target=audited, since=at)) == 6
    assert entries(console, who="nobody") == []
    assert made["id"] in [entry["id"] for entry in entries(console, search=f"creat {audited[:5]}")]
    assert entries(console, search="creat nosuchword") == []
    assert console.http.get("/audit", params={"since": "yesterday"}).status_code == 422


def test_commands_are_in_it_refused_ones_too(console: ConsoleProcess) -> None:
    refused = console.http.post("/rig/commands", json={"command": "resume"})
    assert refused.status_code == 409
    entry = wait_for(lambda: entries(console, action="rig.resume"), "the entry of the command")[0]
    assert entry["outcome"] == f"refused: {refused.json()['code']}"
    assert entry["who"] != "console"


def test_the_chain_is_in_order(console: ConsoleProcess, audited: str) -> None:
    found = console.http.get("/audit/verification").json()
    assert (found["intact"], found["broken_id"]) == (True, None)
    assert found["rows"] >= 6


def test_only_engineers_look(console: ConsoleProcess) -> None:
    for path in ("/audit", "/audit/verification"):
        with console.as_role(Role.OPERATOR) as operator:
            assert operator.get(path).json()["code"] == "not_allowed"
        with console.as_role(Role.ENGINEER) as engineer:
            assert engineer.get(path).status_code == 200


def test_no_secret_is_in_it(console: ConsoleProcess) -> None:
    assert console.token not in json.dumps(entries(console, limit=200))


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("PUT", "/interlocks", {}),
        ("POST", "/drills", {"fault": "pump_loss"}),
        ("POST", "/drills/clear", {}),
        ("GET", "/audit", None),
        ("POST", "/lease", {"reason": "Mine", "take_over": True}),
    ],
)
def test_what_somebody_may_not_is_in_the_audit(
    console: ConsoleProcess, method: str, path: str, body: dict[str, Any] | None
) -> None:
    console.take_command()
    refused = console.as_role(Role.OPERATOR).request(method, path, json=body)
    assert refused.is_client_error, refused.text
    asked = f"{method} /api/v1{path}"
    row = wait_for(lambda: entries(console, target=asked, action="requests.refused"), asked)[0]
    assert row["role"] == "operator"
    assert row["outcome"] == f"refused: {refused.json()['code']}"
    assert row["why"] == refused.json()["detail"]
