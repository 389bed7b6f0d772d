"""The book of runs over the interface: found, noted, and nothing noted lost."""

from typing import Any

import pytest

from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]


@pytest.fixture(scope="module")
def run(console: ConsoleProcess) -> dict[str, Any]:
    console.make_ready()
    run_id = console.start_run("step-2-kn")
    return console.ended_run(run_id)


def found(console: ConsoleProcess, query: str) -> list[int]:
    answer = console.http.get(f"/runs?{query}")
    assert answer.status_code == 200, answer.text
    return [run["id"] for run in answer.json()["runs"]]


def test_a_run_is_found_by_what_it_is(console: ConsoleProcess, run: dict[str, Any]) -> None:
    since = run["started_at"].replace("+", "%2B")
    for query in (
        f"search={run['test_name'].split()[0].upper()}",
        f"search={run['id']}",
        "test_id=step-2-kn",
        "outcome=completed",
        f"verdict={run['verdict']}",
        f"since={since}",
        f"test_id=step-2-kn&outcome=completed&search=step&since={since}",
    ):
        assert run["id"] in found(console, query), query
    for query in ("search=nowhere", "outcome=under_way", f"until={since}", "test_id=step", "tag=x"):
        assert run["id"] not in found(console, query), query


def test_what_is_noted_is_found(console: ConsoleProcess, run: dict[str, Any]) -> None:
    path = f"/runs/{run['id']}"
    now = console.http.get(path).json()
    noted = {"notes": "Größte Kraft: " + "x" * 300, "tags": ["b", "a", "b"], "operator": " Anna "}
    answer = console.http.patch(path, json={**noted, "annotation": now["annotation"]})
    assert answer.status_code == 200, answer.text
    detail = answer.json()
    assert (detail["tags"], detail["operator"], detail["notes"]) == (
        ["a", "b"],
        "Anna",
        noted["notes"],
    )
    assert detail["annotation"] == now["annotation"] + 1
    for query in (
        "search=grösste%20KRAFT",
        "tag=b",
        "operator=Anna",
        "search=anna",
        "search=a%20b",
    ):
        assert run["id"] in found(console, query), query
    assert found(console, "operator=anna") == []
    assert "b" in console.http.get("/runs/tags").json()
    assert "Anna" in console.http.get("/runs/operators").json()
    (summary,) = (r for r in console.http.get("/runs").json()["runs"] if r["id"] == run["id"])
    assert summary["notes"] == noted["notes"][:200]


def test_of_two_who_note_something_the_second_is_told(
    console: ConsoleProcess, run: dict[str, Any]
) -> None:
    path = f"/runs/{run['id']}"
    now = console.http.get(path).json()["annotation"]
    assert console.http.patch(path, json={"notes": "mine", "annotation": now}).is_success
    refused = console.http.patch(path, json={"notes": "theirs", "annotation": now})
    assert (refused.status_code, refused.json()["code"]) == (409, "edit_conflict")
    assert refused.json()["current_annotation"] == now + 1
    assert refused.json()["now"]["notes"] == "mine"
    assert console.http.get(path).json()["notes"] == "mine"


def test_what_is_unchanged_counts_as_no_change(
    console: ConsoleProcess, run: dict[str, Any]
) -> None:
    path = f"/runs/{run['id']}"
    now = console.http.get(path).json()
    same = {name: now[name] for name in ("notes", "tags", "operator", "annotation")}
    assert console.http.patch(path, json=same).json()["annotation"] == now["annotation"]


@pytest.mark.parametrize(
    ("body", "where"),
    [
        ({"notes": "x"}, "body.annotation"),
        ({"notes": "x" * 20_001, "annotation": 0}, "body.notes"),
        ({"tags": ["x" * 51], "annotation": 0}, "body.tags[0]"),
        ({"outcome": "completed", "annotation": 0}, "body.outcome"),
    ],
)
def test_what_cannot_be_noted_is_refused_by_its_place(
    console: ConsoleProcess, run: dict[str, Any], body: dict[str, Any], where: str
) -> None:
    answer = console.http.patch(f"/runs/{run['id']}", json=body)
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["path"] == where


@pytest.mark.parametrize(
    "query",
    [
        "outcome=good",
        "since=yesterday",
        "since=2026-01-01T00:00:00",
        "until=0001-01-01T00:00:00Z",
        "search=" + "x" * 201,
    ],
)
def test_what_cannot_be_asked_is_refused(console: ConsoleProcess, query: str) -> None:
    answer = console.http.get(f"/runs?{query}")
    assert (answer.status_code, answer.json()["code"]) == (422, "invalid_request")
