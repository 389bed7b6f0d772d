"""`/api/v1/interlocks`: the table in force, those before it, and what its detectors see."""

from typing import Annotated

from fastapi import APIRouter, Query

from app.access.dependencies import Engineer, Viewer
from app.dependencies import AuthorityService, InterlocksService, LiveInterlocksTable
from app.interlocks import shown
from app.interlocks.check_schemas import InterlocksCheck
from app.interlocks.record import interlocks_from
from app.interlocks.schemas import (
    InterlocksChange,
    InterlocksDifference,
    InterlocksOut,
    InterlocksText,
    LiveInterlocks,
    RevisionOut,
    TableRevision,
)
from app.problems import PROBLEMS, granted
from app.revisions.requests import Before, Limit, wanted
from app.revisions.schemas import Number

router = APIRouter(prefix="/api/v1/interlocks", tags=["interlocks"], responses=PROBLEMS)


@router.get("", operation_id="getInterlocks")
def get_interlocks(who: Viewer, tables: InterlocksService) -> InterlocksOut:
    """The table in force, by whom, when and why, and whether the loop has it."""
    return shown.in_force(tables.in_force, in_loop=tables.loop_has_it())


@router.put("", operation_id="changeInterlocks")
def change_interlocks(
    who: Engineer, body: InterlocksChange, tables: InterlocksService, authority: AuthorityService
) -> InterlocksOut:
    """Put another table in force, whole or not at all. An old revision is restored by giving it again."""
    table = granted(interlocks_from(shown.document(body), "body"))
    made = granted(tables.change(wanted(who, body, table, authority)))
    return shown.in_force(made, in_loop=tables.loop_has_it())


@router.post("/check", operation_id="checkInterlocks")
def check_interlocks(
    who: Viewer, body: InterlocksText, tables: InterlocksService
) -> InterlocksCheck:
    """What is wrong with a table, and what it would change. Nothing is adopted."""
    return shown.checked(interlocks_from(shown.document(body), "body"), tables.in_force)


@router.get("/live", operation_id="getLiveInterlocks")
def get_live_interlocks(who: Viewer, live: LiveInterlocksTable) -> LiveInterlocks:
    """What every detector sees now."""
    return granted(live.read())


@router.get("/revisions", operation_id="listInterlocksRevisions")
def list_revisions(
    who: Viewer,
    tables: InterlocksService,
    before: Before = None,
    limit: Limit = 100,
) -> list[TableRevision]:
    """The revisions, the newest first."""
    return [shown.summary(row) for row in tables.revisions(before, limit)]


@router.get("/revisions/{number}", operation_id="getInterlocksRevision")
def get_revision(who: Viewer, number: Number, tables: InterlocksService) -> RevisionOut:
    """A table as it was in force once; 0 is the one as shipped."""
    return shown.revision(granted(tables.revision(number)))


@router.get("/difference", operation_id="getInterlocksDifference")
def get_difference(
    who: Viewer,
    tables: InterlocksService,
    from_: Annotated[Number, Query(alias="from")],
    to: Number,
) -> InterlocksDifference:
    """What two revisions differ in, detector by detector, in words."""
    before, after = (granted(tables.revision(number)) for number in (from_, to))
    return shown.difference_of(before.document, after.document, (before.number, after.number))
