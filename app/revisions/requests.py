"""What the routers of all revisions do alike."""

from typing import Annotated, TypeVar

from fastapi import Query
from pydantic import BaseModel

from app.access.principal import Principal
from app.authority.service import Authority
from app.problems import granted
from app.revisions.kind import Wanted
from app.revisions.schemas import Number, Reason

D = TypeVar("D", bound=BaseModel)

Before = Annotated[Number | None, Query(description="the last number of the page before")]
Limit = Annotated[int, Query(ge=1, le=1000)]


def wanted(who: Principal, body: Reason, document: D, authority: Authority) -> Wanted[D]:
    """A document that somebody wants in force; refused where they may not command."""
    epoch = granted(authority.check(who, body.lease))
    return Wanted(document, body.why, body.based_on, who.name, epoch)
