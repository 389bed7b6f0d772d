"""A run as JUnit XML: a test suite with a case for each criterion, and one for whether it came to its end."""

from collections.abc import Mapping, Sequence
from typing import Any
from xml.etree import ElementTree as Xml

COMPLETED = "completed"


def junit(run: Mapping[str, Any], criteria: Sequence[Mapping[str, Any]]) -> bytes:
    """The document; `run` and `criteria` as the console tells them."""
    name = str(run["test_name"])
    suite = Xml.Element("testsuite", name=name, timestamp=str(run["started_at"]))
    duration_s = run.get("duration_s") or 0.0
    suite.set("time", f"{duration_s:.3f}")
    _case(suite, name, "runs to its end", _not_ended(run))
    for criterion in criteria:
        _case(suite, name, _title(criterion), _not_met(criterion))
    suite.set("tests", str(len(suite)))
    suite.set("failures", str(len(suite.findall("testcase/failure"))))
    properties = Xml.Element("properties")
    for key in ("id", "test_id", "revision", "outcome", "verdict", "software_version"):
        Xml.SubElement(properties, "property", name=key, value=str(run.get(key)))
    suite.insert(0, properties)
    Xml.indent(suite)
    document: bytes = Xml.tostring(suite, encoding="utf-8", xml_declaration=True)
    return document + b"\n"


def _case(suite: Xml.Element, name: str, title: str, failure: str | None) -> None:
    case = Xml.SubElement(suite, "testcase", classname=name, name=title)
    if failure is not None:
        Xml.SubElement(case, "failure", message=failure)


def _not_ended(run: Mapping[str, Any]) -> str | None:
    if run["outcome"] == COMPLETED:
        return None
    reason = run.get("reason")
    return f"{run['outcome']}: {reason}" if reason else str(run["outcome"])


def _title(criterion: Mapping[str, Any]) -> str:
    block = criterion["block"]
    where = "" if block is None else f" of block {block + 1}"
    return f"{criterion['measurement']}{where}{_limits(criterion)}"


def _limits(criterion: Mapping[str, Any]) -> str:
    unit = "" if criterion["unit"] in ("1", "-", "") else f" {criterion['unit']}"
    words = (("at least", criterion["at_least"]), ("at most", criterion["at_most"]))
    return "".join(f" {word} {value:g}{unit}" for word, value in words if value is not None)


def _not_met(criterion: Mapping[str, Any]) -> str | None:
    if criterion["outcome"] == "pass":
        return None
    value = criterion["value"]
    unit = "" if criterion["unit"] in ("1", "-", "") else f" {criterion['unit']}"
    return "was not measured" if value is None else f"is {value:g}{unit}"
