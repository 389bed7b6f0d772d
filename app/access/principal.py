"""Who asks, and what they may do."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

from app.errors import Code, Refusal


class Role(IntEnum):
    """What somebody may do; each includes those before it."""

    VIEWER = 0  # look at everything, and stop the rig
    OPERATOR = 1  # command the rig, write and run tests
    ENGINEER = 2  # change interlocks, inject faults, take over command
    ADMIN = 3  # users, tokens

    @property
    def word(self) -> str:
        """As it is written: "viewer" …"""
        return self.name.lower()

    @staticmethod
    def of(word: str) -> "Role":
        """The role of that name."""
        return Role[word.upper()]


@dataclass(frozen=True)
class Principal:
    """Somebody, or a program of theirs, that has shown who they are."""

    id: str  # "session:…" or "token:…": two sessions of one user are two holders of a lease
    name: str
    role: Role
    kind: Literal["session", "token"]
    user_id: int | None = None


def lacking(who: Principal, role: Role) -> Refusal | None:
    """Why somebody may not do what needs this role; None where they may."""
    if who.role >= role:
        return None
    detail = f"This needs the role {role.word}, and {who.name} has the role {who.role.word}"
    return Refusal(Code.NOT_ALLOWED, detail, about={"role_needed": role.word})
