"""Tests that are not saved: read, checked, turned from data into text and back."""

import json
from typing import Any

from app.catalogue.schemas import (
    PreviewAsk,
    PreviewOut,
    ProblemOut,
    SpectrumOut,
    TestChecked,
    TestText,
)
from app.catalogue.written import Reader, Written
from app.definitions.preview import preview as preview_of
from app.definitions.spectrum import read_spectrum
from app.documents.refusal import Problem
from app.documents.tree import Malformed, parse_yaml
from app.documents.writing import data_to_yaml
from app.errors import Code, Fault, Refusal


def read(reader: Reader, text: TestText) -> Written | Refusal:
    """A test as it came in a request."""
    return reader.data(text.definition) if text.yaml is None else reader.yaml(text.yaml)


def check(reader: Reader, text: TestText) -> TestChecked:
    """A test as data and as text with what it comes to, or everything that is wrong with it.

    Both say what was written and no more: defaults are not filled in. What is wrong with a test does
    not keep it from being turned from data into text or back.
    """
    written = read(reader, text)
    if isinstance(written, Refusal):
        return _wrong(reader, text, written)
    as_text = text.yaml is not None
    return TestChecked(
        valid=True,
        problems=[],
        definition=(_data_in(written.yaml) or written.data) if as_text else text.definition,
        yaml=written.yaml if as_text else data_to_yaml(text.definition),
        whole=written.data,
        outline=written.outline,
    )


def preview(reader: Reader, asked: PreviewAsk) -> PreviewOut | Refusal:
    """What a test will do, by the loop's own generator."""
    written = read(reader, asked)
    if isinstance(written, Refusal):
        return written
    found = preview_of(written.definition, asked.from_s, asked.to_s, asked.points)
    return PreviewOut(**dict(found), outline=written.outline)


def spectrum(text: str) -> SpectrumOut:
    """The layers in rows that were pasted."""
    found = read_spectrum(text)
    return SpectrumOut(
        layers=list(found.layers), problems=[_shown(problem) for problem in found.problems]
    )


def revision_in(if_match: str | None) -> int | Refusal | None:
    """The revision that an If-Match header names, None where there is no header."""
    if if_match is None:
        return None
    number = if_match.strip().removeprefix("W/").strip('"')
    if number.isascii() and number.isdecimal() and len(number) < 10:
        return int(number)
    fault = Fault("header.if-match", if_match[:100], 'the number of a revision, as in "3"')
    return Refusal(Code.INVALID_REQUEST, f"{fault.path}: must be {fault.expected}", (fault,))


def _wrong(reader: Reader, text: TestText, refusal: Refusal) -> TestChecked:
    definition, yaml = None, None
    if text.yaml is not None:
        definition = _data_in(text.yaml)
    elif _sendable(text.definition):
        yaml = data_to_yaml(text.definition)
        again = reader.yaml(yaml)  # the same once more, with the lines that it is in
        refusal = again if isinstance(again, Refusal) else refusal
    problems = [_shown(fault) for fault in refusal.faults]
    return TestChecked(valid=False, problems=problems, definition=definition, yaml=yaml)


def _data_in(yaml: str) -> dict[str, Any] | None:
    try:
        data = parse_yaml(yaml).data
    except Malformed:
        return None
    return data if isinstance(data, dict) and _sendable(data) else None


_DEEPEST = 60  # what is nested deeper is not written by people


def _sendable(data: Any) -> bool:
    """Whether JSON can carry it: no infinity, and not nested without end."""

    def shallow(value: Any, depth: int) -> bool:
        below = value.values() if isinstance(value, dict) else value
        if not isinstance(value, dict | list):
            return True
        return depth < _DEEPEST and all(shallow(item, depth + 1) for item in below)

    if not shallow(data, 0):
        return False
    try:
        json.dumps(data, allow_nan=False)
    except ValueError:
        return False
    return True


def _shown(fault: Fault) -> ProblemOut:
    known = (
        fault if isinstance(fault, Problem) else Problem(fault.path, fault.value, fault.expected)
    )
    return ProblemOut(**known.as_data())
