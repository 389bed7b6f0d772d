"""What the requests about access take and give."""

from datetime import datetime
from enum import StrEnum
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.access.models import LONGEST_NAME
from app.access.passwords import LONGEST
from app.access.scopes import Scope
from app.db import NO_NUL

Name = Annotated[str, Field(max_length=LONGEST_NAME, pattern=r"^\w[\w .@-]*$")]
TokenName = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME, pattern=NO_NUL)]
Password = Annotated[str, Field(max_length=LONGEST)]


class RoleWord(StrEnum):
    """What somebody may do; each includes those before it."""

    VIEWER = "viewer"
    OPERATOR = "operator"
    ENGINEER = "engineer"
    ADMIN = "admin"


class _Asked(BaseModel):
    model_config = ConfigDict(extra="forbid")


# ---- signing in ----


class SignIn(_Asked):
    """Who wants to sign in."""

    name: Annotated[str, Field(min_length=1, max_length=200)]
    password: Password


class Me(BaseModel):
    """Who asks. `csrf_token` goes with whatever changes something; null for a token."""

    id: str
    name: str
    user_id: int
    role: RoleWord
    kind: Literal["session", "token"]
    csrf_token: str | None
    must_set_password: bool


class PasswordChange(_Asked):
    """A new password; the old one too, where there is one."""

    old: Password | None = None
    new: Password


class Ticket(BaseModel):
    """For `?ticket=` of a WebSocket: good once, and not for long."""

    ticket: str
    expires_in_s: float


# ---- users ----


class UserOut(BaseModel):
    """A user; `last_seen_at` is null for one who has not been seen in a week."""

    id: int
    name: str
    role: RoleWord
    disabled: bool
    has_password: bool
    created_at: datetime
    last_seen_at: datetime | None


class UserCreate(_Asked):
    """A new user. Without a password, a link lets them in to set one."""

    name: Name
    role: RoleWord
    password: Password | None = None


class UserChange(_Asked):
    """What is to be another; what is not given stays."""

    role: RoleWord | None = None
    disabled: bool | None = None
    password: Password | None = None


class Link(BaseModel):
    """A link that signs its user in, once; `path` goes behind the console's address."""

    path: str
    expires_at: datetime


# ---- tokens and sessions ----


class TokenCreate(_Asked):
    """A new token of one's own; with null for its days it does not expire."""

    name: TokenName
    scope: Scope
    expires_in_days: Annotated[float, Field(gt=0, le=3650, allow_inf_nan=False)] | None = 90


class TokenOut(BaseModel):
    """A token, without what makes it one."""

    id: int
    name: str
    owner: str
    scope: Scope
    created_at: datetime
    expires_at: datetime | None
    last_used_at: datetime | None
    revoked_at: datetime | None


class TokenMade(TokenOut):
    """A new token. `token` is shown this once."""

    token: str


class SessionOut(BaseModel):
    """A browser that is signed in; `present` for the one that asks."""

    id: int
    user: str
    created_at: datetime
    last_seen_at: datetime
    expires_at: datetime
    present: bool
