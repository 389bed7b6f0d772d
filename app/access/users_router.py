"""`/api/v1/users`, for admins."""

from fastapi import APIRouter, Response

from app.access.dependencies import AccessService, Admin
from app.access.schemas import Link, UserChange, UserCreate, UserOut
from app.parameters import Number
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/users", tags=["access"], responses=PROBLEMS)


@router.get("", operation_id="listUsers")
def list_users(who: Admin, access: AccessService) -> list[UserOut]:
    """Everybody who may come in, by name."""
    return access.users.all()


@router.post("", status_code=201, operation_id="addUser")
def add_user(who: Admin, body: UserCreate, access: AccessService, response: Response) -> UserOut:
    """Enter a new user."""
    user = granted(access.users.add(body))
    response.headers["Location"] = f"{router.prefix}/{user.id}"
    return user


@router.patch("/{user_id}", operation_id="changeUser")
def change_user(who: Admin, user_id: Number, body: UserChange, access: AccessService) -> UserOut:
    """Change role or password, disable or enable. A new password ends the user's sessions."""
    return granted(access.users.change(user_id, body, who.user_id))


@router.delete("/{user_id}", status_code=204, operation_id="removeUser")
def remove_user(who: Admin, user_id: Number, access: AccessService) -> None:
    """Remove a user with their sessions and tokens."""
    granted(access.users.remove(user_id, who.user_id))


@router.post("/{user_id}/link", operation_id="linkUser")
def link_user(who: Admin, user_id: Number, access: AccessService) -> Link:
    """A link that signs the user in once, within a day: to set a password."""
    made = granted(access.users.link(user_id))
    return Link(path=made.path, expires_at=made.expires_at)
