"""Who asks, and what they may do."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Literal


class Role(IntEnum):
    """What somebody may do; each includes those before it."""

    VIEWER = 0  # look at everything, and stop the rig
    OPERATOR = 1  # command the rig, write and run tests
    ENGINEER = 2  # change interlocks, inject faults, take over command
    ADMIN = 3  # users, tokens


@dataclass(frozen=True)
class Principal:
    """Somebody, or a program of theirs, that has shown who they are."""

    id: str  # "session:…" or "token:…": two sessions of one user are two holders of a lease
    name: str
    role: Role
    kind: Literal["session", "token"]
    user_id: int | None = None
