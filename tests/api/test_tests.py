"""Tests over the interface: saved, revised, told apart, put aside, and taken in and out as files."""

import json
import zipfile
from io import BytesIO
from typing import Any

import httpx2
import pytest

from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]

YAML = """\
# For the morning.
schema: 1
name: Morning hold
blocks:
  - {kind: ramp, to_n: 1000, rate_n_s: 1000}
  - {kind: hold, duration_s: 1}   # short
"""


def created(console: ConsoleProcess, text: str = YAML, **more: Any) -> dict[str, Any]:
    answer = console.http.post("/tests", json={"yaml": text, **more})
    assert answer.status_code == 201, answer.text
    body: dict[str, Any] = answer.json()
    assert answer.headers["location"] == f"/api/v1/tests/{body['id']}"
    assert answer.headers["etag"] == f'"{body["revision"]}"'
    return body


def code(answer: httpx2.Response) -> tuple[int, str]:
    assert answer.headers["content-type"] == "application/problem+json", answer.text
    return answer.status_code, answer.json()["code"]


def test_what_ships_is_there_once(console: ConsoleProcess) -> None:
    tests = {test["id"]: test for test in console.http.get("/tests").json()}
    assert tests["hold-50-kn"]["revision"] == 1
    assert tests["hold-50-kn"]["peak_force_n"] == pytest.approx(50e3)
    detail = console.http.get("/tests/hold-50-kn").json()
    assert detail["author"] == "forcerig"
    assert detail["outline"]["blocks"]


def test_a_test_keeps_the_text_that_was_written(console: ConsoleProcess) -> None:
    first = created(console, author="Anna", comment="first", tags=["morning", "hold"])
    assert (first["yaml"], first["author"], first["revision"]) == (YAML, "Anna", 1)
    assert first["tags"] == ["hold", "morning"]
    assert first["definition"]["blocks"][0]["to_n"] == 1000
    assert created(console)["id"] == f"{first['id']}-2"


@pytest.mark.parametrize("form", ["bare", "yaml"])
def test_a_definition_alone_will_do(console: ConsoleProcess, form: str) -> None:
    definition = created(console)["definition"]
    if form == "bare":
        answer = console.http.post("/tests", json=definition)
    else:
        headers = {"Content-Type": "application/yaml"}
        answer = console.http.post("/tests", content=YAML.encode(), headers=headers)
    assert answer.status_code == 201, answer.text
    assert answer.json()["definition"] == definition


def test_of_two_who_save_the_same_test_the_second_is_told(console: ConsoleProcess) -> None:
    test = created(console)
    path = f"/tests/{test['id']}"
    mine = {"yaml": YAML.replace("1000}", "2000}"), "author": "Anna", "based_on": 1}
    theirs = {"yaml": YAML.replace("duration_s: 1", "duration_s: 2"), "author": "Otto"}
    assert code(console.http.put(path, json=theirs)) == (428, "revision_needed")
    saved = console.http.put(path, json=mine)
    assert (saved.status_code, saved.headers["etag"]) == (200, '"2"')
    refused = console.http.put(path, json=theirs, headers={"If-Match": '"1"'})
    assert code(refused) == (409, "edit_conflict")
    assert refused.json()["current_revision"] == 2
    assert "Anna saved revision 2" in refused.json()["detail"]
    assert console.http.get(path).json()["yaml"] == mine["yaml"]
    again = console.http.put(path, json=theirs, headers={"If-Match": '"2"'})
    assert again.json()["revision"] == 3
    numbers = [(r["number"], r["author"]) for r in console.http.get(f"{path}/revisions").json()]
    assert numbers == [(3, "Otto"), (2, "Anna"), (1, "")]
    assert console.http.get(f"{path}/revisions/1").json()["yaml"] == YAML


def test_what_is_unchanged_is_no_new_revision(console: ConsoleProcess) -> None:
    test = created(console)
    for body in ({"yaml": YAML}, {"definition": test["definition"]}):
        answer = console.http.put(f"/tests/{test['id']}", json={**body, "based_on": 1})
        assert (answer.status_code, answer.json()["revision"]) == (200, 1)


def test_an_old_revision_is_told_apart_and_taken_back(console: ConsoleProcess) -> None:
    test = created(console)
    path = f"/tests/{test['id']}"
    body = {"yaml": YAML.replace("to_n: 1000", "to_n: 1500"), "based_on": 1}
    assert console.http.put(path, json=body).is_success
    difference = console.http.get(f"{path}/difference?from=1&to=2").json()
    assert (difference["from"], difference["to"]) == (1, 2)
    assert "-  - {kind: ramp, to_n: 1000, rate_n_s: 1000}\n" in difference["text"]
    assert "+  - {kind: ramp, to_n: 1500, rate_n_s: 1000}\n" in difference["text"]
    (change,) = difference["changes"]
    assert change == {
        "path": "blocks[0].to_n",
        "before": 1000.0,
        "after": 1500.0,
        "kind": "changed",
    }
    restored = console.http.post(f"{path}/revisions/1/restore")
    assert (restored.json()["revision"], restored.json()["yaml"]) == (3, YAML)
    assert code(console.http.get(f"{path}/revisions/9")) == (404, "unknown_revision")


def test_an_archived_test_is_away_and_comes_back(console: ConsoleProcess) -> None:
    test = created(console)
    path = f"/tests/{test['id']}"
    assert console.http.delete(path).status_code == 204
    ids = [test["id"] for test in console.http.get("/tests").json()]
    everything = {t["id"]: t["archived"] for t in console.http.get("/tests?archived=true").json()}
    assert test["id"] not in ids
    assert everything[test["id"]] is True
    assert console.http.post(f"{path}/restore").json()["archived"] is False


def test_a_clone_has_its_own_name_and_the_comments(console: ConsoleProcess) -> None:
    test = created(console, tags=["morning"])
    answer = console.http.post(f"/tests/{test['id']}/clone", json={"name": "Evening: hold"})
    assert answer.status_code == 201, answer.text
    assert (answer.json()["id"], answer.json()["name"]) == ("evening-hold", "Evening: hold")
    assert answer.json()["tags"] == ["morning"]
    assert "# short" in answer.json()["yaml"]
    assert console.http.delete("/tests/evening-hold").is_success


def test_tests_are_found_by_words_and_by_tags(console: ConsoleProcess) -> None:
    test = created(console, YAML.replace("Morning hold", "Größte Kraft"), tags=["Ärmel"])

    def found(query: str) -> bool:
        return test["id"] in [t["id"] for t in console.http.get(f"/tests?{query}").json()]

    assert found("search=GRÖSSTE")
    assert found("search=kraft gr")
    assert not found("search=kraft nichts")
    assert found("tag=Ärmel")
    assert console.http.put(f"/tests/{test['id']}/tags", json={"tags": ["x"]}).is_success
    assert not found("tag=Ärmel")


def test_the_list_comes_in_pages(console: ConsoleProcess) -> None:
    created(console)
    ids = [test["id"] for test in console.http.get("/tests").json()]
    assert ids == sorted(ids)
    page = console.http.get(f"/tests?limit=2&after={ids[0]}").json()
    assert [test["id"] for test in page] == ids[1:3]


@pytest.mark.parametrize("form", ["yaml", "definition"])
def test_a_check_turns_one_form_into_the_other(console: ConsoleProcess, form: str) -> None:
    whole = console.http.post("/tests/check", json={"yaml": YAML}).json()
    checked = console.http.post("/tests/check", json={form: whole[form]}).json()
    assert checked["valid"]
    assert checked["definition"] == whole["definition"]
    assert checked["whole"] == whole["whole"] != whole["definition"]
    assert checked["outline"]["duration_s"] == pytest.approx(2.0)
    assert checked["yaml"].startswith("# For" if form == "yaml" else "schema: 1")


def test_a_check_says_where_and_what_would_be_right(console: ConsoleProcess) -> None:
    text = YAML.replace("rate_n_s: 1000", "rate_n_s: 1e12")
    checked = console.http.post("/tests/check", json={"yaml": text}).json()
    (problem,) = checked["problems"]
    assert (checked["valid"], problem["path"], problem["line"]) == (False, "blocks[0].rate_n_s", 5)
    assert problem["unit"] == "N/s"
    refused = console.http.post("/tests", json={"yaml": text})
    assert code(refused) == (422, "invalid_test")
    (fault,) = refused.json()["errors"]
    assert (fault["path"], fault["line"]) == ("blocks[0].rate_n_s", 5)
    assert fault["limit"] < 1e12


def test_a_check_turns_what_is_wrong_into_the_other_form_too(console: ConsoleProcess) -> None:
    text = YAML.replace("rate_n_s: 1000", "rate_n_s: 1e12")
    data = console.http.post("/tests/check", json={"yaml": text}).json()["definition"]
    assert data["blocks"][0]["rate_n_s"] == 1e12
    checked = console.http.post("/tests/check", json={"definition": data}).json()
    (problem,) = checked["problems"]
    line = checked["yaml"].splitlines()[problem["line"] - 1]
    assert (checked["valid"], "1000000000000" in line) == (False, True)
    for nonsense in ({"yaml": "a: ["}, {"yaml": "a: .inf"}, {"yaml": "7"}):
        assert console.http.post("/tests/check", json=nonsense).json()["definition"] is None


def test_a_preview_is_what_will_be_played(console: ConsoleProcess) -> None:
    asked = {"yaml": YAML, "from_s": 0.5, "to_s": 1.5, "points": 4}
    preview = console.http.post("/tests/preview", json=asked).json()
    assert preview["time_s"] == pytest.approx([0.5, 0.75, 1.0, 1.25], abs=1e-3)
    assert preview["force_max_n"] == pytest.approx([750, 1000, 1000, 1000], abs=1)
    assert preview["force_min_n"] == pytest.approx([500, 750, 1000, 1000], abs=1)
    assert preview["peaks"]["force_rate_n_s"] == pytest.approx(1000, rel=0.01)
    assert preview["outline"]["duration_s"] == pytest.approx(2.0)
    refused = console.http.post("/tests/preview", json={"yaml": "schema: 1"})
    assert code(refused) == (422, "invalid_test")


def test_a_spectrum_is_read_as_it_was_pasted(console: ConsoleProcess) -> None:
    text = "Amplitude [kN];Frequency;Cycles\n1,5;10;100\n2;x;5\n"
    spectrum = console.http.post("/tests/spectrum", json={"text": text}).json()
    assert spectrum["layers"][0]["amplitude_n"] == pytest.approx(1500)
    (problem,) = spectrum["problems"]
    assert (problem["path"], problem["line"]) == ("layers[1].frequency_hz", 3)


def test_a_library_goes_out_and_comes_back(console: ConsoleProcess) -> None:
    test = created(console, tags=["a", "b"])
    packed = console.http.get(f"/tests/library.zip?ids={test['id']},hold-50-kn").content
    with zipfile.ZipFile(BytesIO(packed)) as archive:
        assert archive.read(f"{test['id']}.yaml").decode() == YAML
    headers = {"Content-Type": "application/zip"}
    answer = console.http.post("/tests/import", content=packed, headers=headers)
    actions = {one["id"]: one["action"] for one in answer.json()["imported"]}
    assert actions == {test["id"]: "unchanged", "hold-50-kn": "unchanged"}


def test_an_import_is_all_or_nothing(console: ConsoleProcess) -> None:
    files = {
        "good-one.yaml": YAML,
        "bad-one.yaml": YAML.replace("hold,", "hold up,"),
        "../bad-two.yaml": YAML,
    }
    answer = console.http.post("/tests/import", json={"files": files})
    assert code(answer) == (422, "invalid_test")
    assert [fault["path"] for fault in answer.json()["errors"]] == [
        "bad-one.yaml:blocks[1].kind",
        "../bad-two.yaml",
    ]
    assert console.http.get("/tests/good-one").status_code == 404
    answer = console.http.post("/tests/import", json={"files": {"good-one.yaml": YAML}})
    assert answer.json()["imported"] == [
        {"name": "good-one.yaml", "id": "good-one", "action": "created"}
    ]


def test_a_test_is_had_as_a_file(console: ConsoleProcess) -> None:
    test = created(console)
    answer = console.http.get(f"/tests/{test['id']}/definition.yaml")
    assert answer.text == YAML
    assert test["id"] in answer.headers["content-disposition"]
    data = console.http.get(f"/tests/{test['id']}/definition.json").text
    assert json.loads(data) == test["definition"]


@pytest.mark.parametrize(
    ("body", "status", "where"),
    [
        ({}, 422, "body"),
        ({"yaml": YAML, "definition": {}}, 422, "body"),
        ({"yaml": YAML, "id": "No Id"}, 422, "body.id"),
        ({"yaml": YAML, "tags": ["x" * 51]}, 422, "body.tags[0]"),
        ({"yaml": "x" * 500_001}, 422, "body.yaml"),
        ({"yaml": YAML, "author": "x" * 101}, 422, "body.author"),
    ],
)
def test_what_cannot_be_saved_is_refused_by_its_place(
    console: ConsoleProcess, body: dict[str, Any], status: int, where: str
) -> None:
    answer = console.http.post("/tests", json=body)
    assert answer.status_code == status
    assert answer.json()["errors"][0]["path"] == where


def test_an_id_is_not_taken_twice_where_it_was_asked_for(console: ConsoleProcess) -> None:
    answer = console.http.post("/tests", json={"yaml": YAML, "id": "hold-50-kn"})
    assert code(answer) == (409, "test_exists")


@pytest.mark.parametrize("announced", [True, False])
def test_too_much_is_refused(console: ConsoleProcess, *, announced: bool) -> None:
    content = b" " * 5_000_000
    body = content if announced else iter([content])
    answer = console.http.post("/tests/check", content=body)
    assert code(answer) == (413, "too_large")
