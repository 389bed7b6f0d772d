"""What a router asks for where it needs a right."""

from collections.abc import Awaitable, Callable
from typing import Annotated

from fastapi import Depends
from fastapi.requests import HTTPConnection

from app.access.door import principal_of
from app.access.principal import Principal, Role, lacking
from app.access.refusals import NOT_SIGNED_IN
from app.access.refused import ROLE_ASKED
from app.access.service import Access
from app.dependencies import ThisConsole
from app.problems import granted


def require(role: Role) -> Callable[[HTTPConnection], Awaitable[Principal]]:
    """A dependency: who asks, where they have this role. `app.access.door` has found out who it is."""

    async def who(connection: HTTPConnection) -> Principal:
        found = principal_of(connection.scope)
        if found is None:
            return granted(NOT_SIGNED_IN)
        setattr(connection.state, ROLE_ASKED, role)
        return granted(lacking(found, role) or found)

    who.requires = role  # type: ignore[attr-defined]  # for whoever lists what is asked where
    return who


def _access(this: ThisConsole) -> Access:
    return this.access


Viewer = Annotated[Principal, Depends(require(Role.VIEWER))]
Operator = Annotated[Principal, Depends(require(Role.OPERATOR))]
Engineer = Annotated[Principal, Depends(require(Role.ENGINEER))]
Admin = Annotated[Principal, Depends(require(Role.ADMIN))]
AccessService = Annotated[Access, Depends(_access)]
