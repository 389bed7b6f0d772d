"""Why something about a test is refused, in sentences that say what to do."""

from app.catalogue.models import Test, TestRevision
from app.errors import Code, Refusal


def unknown(test_id: str) -> Refusal:
    """There is no such test."""
    return Refusal(Code.UNKNOWN_TEST, f"There is no test {test_id!r}")


def unknown_revision(test: Test, number: int) -> Refusal:
    """There is no such revision."""
    detail = f"Test {test.id!r} has no revision {number}: its newest is {test.revision}"
    return Refusal(Code.UNKNOWN_REVISION, detail, about={"current_revision": test.revision})


def exists(test_id: str) -> Refusal:
    """The id is taken."""
    detail = f"There is a test {test_id!r} already: save a revision of it, or give another id"
    return Refusal(Code.TEST_EXISTS, detail)


def archived(test_id: str) -> Refusal:
    """It was put aside."""
    return Refusal(Code.TEST_ARCHIVED, f"Test {test_id!r} is archived: restore it first")


def conflict(test: Test, newest: TestRevision, based_on: int) -> Refusal:
    """Somebody else saved in the meantime."""
    who, when = newest.author or "Somebody", f"{newest.created_at:%Y-%m-%d %H:%M:%S} UTC"
    detail = (
        f"{who} saved revision {newest.number} of this test at {when}, and this was made from "
        f"revision {based_on}: look at the difference, then save on top of revision {newest.number}"
    )
    return Refusal(
        Code.EDIT_CONFLICT,
        detail,
        about={
            "current_revision": test.revision,
            "author": newest.author,
            "saved_at": newest.created_at.isoformat(),
        },
    )


def no_longer_valid(revision: TestRevision, refusal: Refusal) -> Refusal:
    """It was valid when it was saved."""
    detail = (
        f"Revision {revision.number} of test {revision.test_id!r} was valid when it was saved, and "
        f"is not any more: save a new revision.\n{refusal.detail}"
    )
    return Refusal(refusal.code, detail, refusal.faults)
