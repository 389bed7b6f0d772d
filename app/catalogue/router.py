"""`/api/v1/tests`: the list, the tests and their revisions."""

from typing import Annotated

from fastapi import APIRouter, Header, Path, Query, Response

from app.access.dependencies import Operator, Viewer
from app.catalogue import texts
from app.catalogue.differences import difference_of
from app.catalogue.saving import Saved
from app.catalogue.schemas import (
    LONGEST_ID,
    Difference,
    Number,
    RevisionSummary,
    TestAuthor,
    TestClone,
    TestCreate,
    TestDetail,
    TestEdit,
    TestSave,
    TestSummary,
    TestTags,
)
from app.dependencies import CatalogueService
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/tests", tags=["tests"], responses=PROBLEMS)
TestId = Annotated[str, Path(max_length=LONGEST_ID)]
IfMatch = Annotated[str | None, Header(description='the revision it was made from: "3"')]


@router.get("", operation_id="listTests")
def list_tests(
    who: Viewer,
    catalogue: CatalogueService,
    search: Annotated[str, Query(max_length=200)] = "",
    tag: Annotated[str | None, Query(max_length=50)] = None,
    archived: Annotated[bool, Query(description="the archived ones too")] = False,
    limit: Annotated[int, Query(ge=1, le=1000)] = 1000,
    after: Annotated[str | None, Query(max_length=LONGEST_ID)] = None,
) -> list[TestSummary]:
    """The tests, by their ids; `after` is the last id of the page before."""
    return catalogue.list_tests(search=search, tag=tag, archived=archived, after=after, limit=limit)


@router.post("", status_code=201, operation_id="createTest")
def create_test(
    who: Operator, body: TestCreate, catalogue: CatalogueService, response: Response
) -> TestDetail:
    """Save a new test."""
    test = granted(
        catalogue.create(granted(texts.read(catalogue.reader, body)), _saved(body), body.id)
    )
    response.headers["Location"] = f"{router.prefix}/{test.id}"
    return _newest(catalogue, test.id, response)


@router.get("/{test_id}", operation_id="getTest")
def get_test(
    who: Viewer, test_id: TestId, catalogue: CatalogueService, response: Response
) -> TestDetail:
    """A test with its definition and what it comes to; the ETag is its revision."""
    return _newest(catalogue, test_id, response)


@router.put("/{test_id}", operation_id="saveTest")
def save_test(
    who: Operator,
    test_id: TestId,
    body: TestEdit,
    catalogue: CatalogueService,
    response: Response,
    if_match: IfMatch = None,
) -> TestDetail:
    """Save a new revision, on top of the one that it was made from and no other."""
    based_on = body.based_on if body.based_on is not None else granted(texts.revision_in(if_match))
    granted(
        catalogue.save(test_id, granted(texts.read(catalogue.reader, body)), _saved(body), based_on)
    )
    return _newest(catalogue, test_id, response)


@router.delete("/{test_id}", status_code=204, operation_id="archiveTest")
def archive_test(who: Operator, test_id: TestId, catalogue: CatalogueService) -> None:
    """Put a test aside: it can be restored, and its runs keep what they were made with."""
    granted(catalogue.set_archived(test_id, True))


@router.post("/{test_id}/restore", operation_id="restoreTest")
def restore_test(
    who: Operator, test_id: TestId, catalogue: CatalogueService, response: Response
) -> TestDetail:
    """Take a test back that was put aside."""
    granted(catalogue.set_archived(test_id, False))
    return _newest(catalogue, test_id, response)


@router.post("/{test_id}/clone", status_code=201, operation_id="cloneTest")
def clone_test(
    who: Operator,
    test_id: TestId,
    catalogue: CatalogueService,
    response: Response,
    body: TestClone | None = None,
) -> TestDetail:
    """A copy of the newest revision under another name."""
    asked = body or TestClone()
    test = granted(catalogue.clone(test_id, asked.name, asked.author))
    response.headers["Location"] = f"{router.prefix}/{test.id}"
    return _newest(catalogue, test.id, response)


@router.put("/{test_id}/tags", operation_id="tagTest")
def tag_test(
    who: Operator, test_id: TestId, body: TestTags, catalogue: CatalogueService, response: Response
) -> TestDetail:
    """Give a test these tags and no others."""
    granted(catalogue.set_tags(test_id, body.tags))
    return _newest(catalogue, test_id, response)


@router.get("/{test_id}/revisions", operation_id="listRevisions")
def list_revisions(
    who: Viewer, test_id: TestId, catalogue: CatalogueService
) -> list[RevisionSummary]:
    """The revisions, the newest first."""
    return granted(catalogue.revisions(test_id))


@router.get("/{test_id}/revisions/{number}", operation_id="getRevision")
def get_revision(
    who: Viewer, test_id: TestId, number: Number, catalogue: CatalogueService
) -> TestDetail:
    """The test as it was in a revision."""
    return granted(catalogue.get_test(test_id, number))


@router.post("/{test_id}/revisions/{number}/restore", operation_id="restoreRevision")
def restore_revision(
    who: Operator,
    test_id: TestId,
    number: Number,
    catalogue: CatalogueService,
    response: Response,
    body: TestAuthor | None = None,
) -> TestDetail:
    """Save an old revision again, as the newest one."""
    granted(catalogue.restore_revision(test_id, number, body or TestAuthor()))
    return _newest(catalogue, test_id, response)


@router.get("/{test_id}/difference", operation_id="getDifference")
def get_difference(
    who: Viewer,
    test_id: TestId,
    catalogue: CatalogueService,
    from_: Annotated[Number, Query(alias="from")],
    to: Number,
) -> Difference:
    """What two revisions differ in."""
    before, after = (granted(catalogue.texts(test_id, number)) for number in (from_, to))
    return difference_of(before, after)


def _newest(catalogue: CatalogueService, test_id: str, response: Response) -> TestDetail:
    detail = granted(catalogue.get_test(test_id))
    response.headers["ETag"] = f'"{detail.revision}"'
    return detail


def _saved(body: TestSave) -> Saved:
    return Saved(body.author, body.comment, body.tags)
