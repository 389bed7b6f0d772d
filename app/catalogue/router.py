"""`/api/v1/tests`."""

from typing import Annotated

from fastapi import APIRouter, Path

from app.catalogue import service
from app.catalogue.schemas import TestDetail, TestSummary
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/tests", tags=["tests"], responses=PROBLEMS)


@router.get("", operation_id="listTests")
def list_tests() -> list[TestSummary]:
    """The tests that can be run."""
    return service.list_tests()


@router.get("/{test_id}", operation_id="getTest")
def get_test(test_id: Annotated[str, Path(max_length=100)]) -> TestDetail:
    """A test with its definition and what it comes to."""
    return granted(service.get_test(test_id))
