"""`/api/v1/audit`."""

from typing import Annotated

from fastapi import APIRouter, Query

from app.access.dependencies import Engineer
from app.audit.schemas import AuditPage, Verification
from app.audit.sought import Sought
from app.dependencies import AuditService
from app.parameters import Before, Limit
from app.problems import PROBLEMS
from app.runs.schemas import Moment

router = APIRouter(prefix="/api/v1/audit", tags=["audit"], responses=PROBLEMS)
Text = Annotated[str | None, Query(max_length=200)]


@router.get("", operation_id="listAudit")
def list_audit(
    audit: AuditService,
    reader: Engineer,
    who: Text = None,
    action: Annotated[str | None, Query(max_length=200, description="or its beginning")] = None,
    target: Text = None,
    since: Moment | None = None,
    until: Annotated[Moment | None, Query(description="and not then")] = None,
    search: Annotated[str, Query(max_length=200, description="beginnings of words")] = "",
    limit: Limit = 50,
    before: Before = None,
) -> AuditPage:
    """The newest entries first; `next` of a page is `before` of the page after it."""
    return audit.page(Sought(who, action, target, since, until, search), limit, before)


@router.get("/verification", operation_id="verifyAudit")
def verify_audit(audit: AuditService, reader: Engineer) -> Verification:
    """Walk the whole chain: whether every entry is as it was entered, and none is gone."""
    return audit.verify()
