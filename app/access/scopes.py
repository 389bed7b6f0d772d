"""What a token may do: each scope is a role, said for a script."""

from enum import StrEnum

from app.access.principal import Role


class Scope(StrEnum):
    """Of a token; each includes those before it."""

    READ = "read"
    OPERATE = "operate"
    ENGINEER = "engineer"
    ADMIN = "admin"


def role_of(scope: str) -> Role:
    """The role that a scope gives where its owner has it."""
    return Role(list(Scope).index(Scope(scope)))


def scope_of(role: Role) -> Scope:
    """The scope that gives all that a role may do."""
    return list(Scope)[role]
