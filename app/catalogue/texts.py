"""Tests that are not saved: read, checked, turned from data into text and back."""

from app.catalogue.schemas import ProblemOut, TestChecked, TestText
from app.catalogue.written import Reader, Written
from app.documents.refusal import Problem
from app.errors import Code, Fault, Refusal


def read(reader: Reader, text: TestText) -> Written | Refusal:
    """A test as it came in a request."""
    return reader.data(text.definition) if text.yaml is None else reader.yaml(text.yaml)


def check(reader: Reader, text: TestText) -> TestChecked:
    """A test as data and as text with what it comes to, or everything that is wrong with it."""
    written = read(reader, text)
    if isinstance(written, Refusal):
        return TestChecked(valid=False, problems=[_shown(fault) for fault in written.faults])
    return TestChecked(
        valid=True,
        problems=[],
        definition=written.data,
        yaml=written.yaml,
        outline=written.outline,
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


def _shown(fault: Fault) -> ProblemOut:
    known = (
        fault if isinstance(fault, Problem) else Problem(fault.path, fault.value, fault.expected)
    )
    return ProblemOut(**known.as_data())
