"""The interface keeps to what its own OpenAPI document says, whatever it is asked."""

import json
from pathlib import Path
from typing import Any

import pytest
import schemathesis
from hypothesis import given, settings
from schemathesis import Case, CheckContext, GenerationMode, Response
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from app.problems import MEDIA_TYPE, Problem
from tests.console_process import ConsoleProcess
from tests.unit.app.definitions.strategies import definitions, every_block

pytestmark = [pytest.mark.process, pytest.mark.slow]
DOCUMENT = Path(__file__).parents[2] / "web" / "src" / "gen" / "openapi.json"
ASKING = [
    "checkTest",
    "previewTest",
    "readSpectrum",
    "checkController",
]  # POST, but nothing is changed
PATIENCE_S = 120.0  # a report is made while one waits
EXAMPLES = 10  # of each operation, beside those at the limits of each parameter
SOME = settings(max_examples=15, derandomize=True)

interface = schemathesis.openapi.from_path(str(DOCUMENT))
interface.config.generation.update(
    modes=list(GenerationMode), deterministic=True, max_examples=EXAMPLES, database="none"
)
reading = interface.include(method="GET")
asking = interface.include(operation_id=ASKING)
savable = definitions(every_block).filter(lambda d: "\0" not in d["name"] + d["description"])
AnyCase = Case[Any]
Known = dict[str, Any]
# Neither an identification nor a report is made by reading; drills and trips are other tests'.
NONE_MADE = ["not_found", "unknown_revision", "unknown_first_out"]


def is_a_problem_document(ctx: CheckContext, response: Response, case: AnyCase) -> bool | None:
    """A refusal says what it is by its media type, and tells its own status."""
    if response.status_code < 400 or case.operation.path == "/healthz":
        return None
    assert response.headers["content-type"] == [MEDIA_TYPE]
    body = Problem.model_validate_json(response.content)
    assert body.status == response.status_code
    assert body.title
    assert body.detail
    return None


CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    is_a_problem_document,
]


def asked(case: AnyCase, console: ConsoleProcess) -> Response:
    """The answer, which is as described."""
    return case.call_and_validate(
        base_url=console.url, headers=console.headers, checks=CHECKS, timeout=PATIENCE_S
    )


@pytest.fixture(scope="module")
def known(console: ConsoleProcess) -> Known:
    """What a path may name: a test, its revision, a run of it, and a table that it took."""
    console.make_ready()
    definition = {
        "schema": 1,
        "name": "For every question",
        "blocks": [{"kind": "harmonic", "amplitude_n": 1000, "frequency_hz": 20, "cycles": 5}],
        "record": {"also": [{"kind": "peak_valley"}]},
        "acceptance": [{"measurement": "cycles", "at_least": 1}],
    }
    answer = console.http.post("/tests", json={"definition": definition})
    assert answer.status_code == 201, answer.text
    test_id = answer.json()["id"]
    run_id = console.start_run(test_id)
    console.ended_run(run_id)
    preview = console.http.post("/controller/preview", json={"document": {}}).json()
    export = console.http.post(f"/runs/{run_id}/exports", json={"format": "csv"}).json()
    there = {"test_id": test_id, "number": 1, "run_id": run_id, "index": 0, "ending": "csv"}
    return there | {"preview_id": preview["id"], "export_id": export["id"]}


def test_the_console_describes_what_is_committed(console: ConsoleProcess) -> None:
    served = console.http.get(f"{console.url}/openapi.json").json()
    assert served["paths"] == json.loads(DOCUMENT.read_text())["paths"]


@reading.parametrize()
def test_what_is_read(case: AnyCase, console: ConsoleProcess, known: Known) -> None:
    asked(case, console)
    if case.path_parameters:
        names = case.path_parameters.keys()
        case.path_parameters = {name: known[name] for name in names}
        answer = asked(case, console)
        if answer.status_code == 404:
            expected = ["unknown_drill"] if "/drills/" in case.path else NONE_MADE
            assert answer.json()["code"] in expected


NUL = [
    "/runs?search=%00", "/runs?test_id=%00", "/runs?tag=%00", "/runs?operator=a%00b",
    "/tests?search=a%00b", "/tests?tag=%00", "/tests?after=%00", "/tests/%00",
    "/tests/%00/revisions", "/tests/%00/difference?from=1&to=1", "/tests/%00/definition.yaml",
    "/tests/library.zip?ids=%00", "/tests/library.zip?tag=%00",
    "/storage/retention/preview?keep_tags=%00",
]  # fmt: skip


@pytest.mark.parametrize("path", NUL)
def test_the_one_character_that_postgresql_does_not_know(
    console: ConsoleProcess, path: str
) -> None:
    answer = console.http.get(path)
    assert (answer.status_code, answer.json()["code"]) == (422, "invalid_request")


@asking.parametrize()
def test_what_is_asked(case: AnyCase, console: ConsoleProcess) -> None:
    asked(case, console)


@pytest.mark.parametrize("operation", ["checkTest", "previewTest"])
@SOME
@given(definition=savable)
def test_what_is_asked_of_whole_tests(
    operation: str, definition: Known, console: ConsoleProcess
) -> None:
    found = interface.find_operation_by_id(operation)
    case = found.Case(body={"definition": definition}, media_type="application/json")
    answer = asked(case, console)
    assert answer.status_code == 200, answer.text
