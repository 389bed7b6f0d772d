"""The tests of the library."""

from functools import cache

from app.catalogue.schemas import TestDetail, TestSummary
from app.definitions.definition import Definition
from app.definitions.library import library, library_text
from app.definitions.outline import Outline, outline
from app.errors import Code, Refusal


def list_tests() -> list[TestSummary]:
    """Every test, in the order of the ids."""
    return [_summary(test_id, definition) for test_id, definition in library().items()]


def get_test(test_id: str) -> TestDetail | Refusal:
    """A test with its definition."""
    definition = library().get(test_id)
    if definition is None:
        return Refusal(Code.UNKNOWN_TEST, f"There is no test {test_id!r}")
    return TestDetail(
        **_summary(test_id, definition).model_dump(),
        definition=definition.model_dump(mode="json", by_alias=True),
        yaml=library_text(test_id),
        outline=_outline(test_id),
    )


def _summary(test_id: str, definition: Definition) -> TestSummary:
    expected = _outline(test_id)
    return TestSummary(
        id=test_id,
        name=definition.name,
        description=definition.description,
        duration_s=expected.duration_s,
        peak_force_n=expected.peak_force_n,
        blocks=len(definition.blocks),
    )


@cache
def _outline(test_id: str) -> Outline:
    return outline(library()[test_id])
