"""What the requests about tests give."""

from typing import Any

from pydantic import BaseModel

from app.definitions.outline import Outline


class TestSummary(BaseModel):
    """A test in the list."""

    __test__ = False  # pytest would take it for a test of ours

    id: str
    name: str
    description: str
    duration_s: float
    peak_force_n: float
    blocks: int


class TestDetail(TestSummary):
    """A test with its definition as data and as text, and what it comes to."""

    definition: dict[str, Any]
    yaml: str
    outline: Outline
