from typing import Any
from xml.etree import ElementTree as Xml

from app.commands.remote.junit import junit

RUN: dict[str, Any] = {
    "id": 7,
    "test_id": "step",
    "revision": 2,
    "test_name": "Step & hold",
    "duration_s": 2.5,
    "started_at": "2026-01-02T03:04:05Z",
    "outcome": "completed",
    "verdict": "fail",
    "reason": None,
    "software_version": "0",
}
CRITERION: dict[str, Any] = {
    "measurement": "peak_force_n",
    "block": 0,
    "unit": "N",
    "value": 2100.0,
    "at_least": 2000.0,
    "at_most": None,
    "outcome": "pass",
}


def suite(run: dict[str, Any], *criteria: dict[str, Any]) -> Xml.Element:
    return Xml.fromstring(junit(run, criteria))


def test_each_criterion_is_a_case() -> None:
    failed = CRITERION | {"at_most": 2050.0, "outcome": "fail"}
    unmeasured = CRITERION | {"value": None, "outcome": "unset", "block": None}
    found = suite(RUN, CRITERION, failed, unmeasured)
    cases = [
        (case.get("name"), [f.get("message") for f in case]) for case in found.iter("testcase")
    ]
    assert cases == [
        ("runs to its end", []),
        ("peak_force_n of block 1 at least 2000 N", []),
        ("peak_force_n of block 1 at least 2000 N at most 2050 N", ["is 2100 N"]),
        ("peak_force_n at least 2000 N", ["was not measured"]),
    ]
    assert (found.get("tests"), found.get("failures"), found.get("name")) == (
        "4",
        "2",
        "Step & hold",
    )


def test_a_trip_is_a_failure_with_its_reason() -> None:
    found = suite(RUN | {"outcome": "tripped", "reason": "Force above 5 kN"})
    (failure,) = found.iter("failure")
    assert failure.get("message") == "tripped: Force above 5 kN"
