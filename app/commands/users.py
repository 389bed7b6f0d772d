"""`forcerig user …`."""

import sys
from getpass import getpass
from pathlib import Path

from rich.table import Table

from app.access.schemas import Link, UserChange, UserCreate, UserOut
from app.access.tokens import Tokens
from app.access.users import Users
from app.commands.access import answer, on_database, read, settings_of
from app.commands.output import Exit, side_console
from app.errors import Code, Refusal
from app.settings import Settings


def add(name: str, role: str, *, data: Path | None, as_json: bool) -> Exit:
    """Enter a user."""
    asked = read(UserCreate, name=name, role=role)
    if isinstance(asked, Refusal):
        return answer(asked, as_json, str)
    found = on_database(settings_of(data), lambda users, _: users.add(asked))
    return answer(
        found,
        as_json,
        lambda user: (
            f"{user.name} is {user.role.value}. Let them in: forcerig user link {user.name}"
        ),
    )


def show(*, data: Path | None, as_json: bool) -> Exit:
    """List everybody."""
    return answer(on_database(settings_of(data), lambda users, _: users.all()), as_json, _table)


def change(name: str, *, data: Path | None, as_json: bool, **asked: object) -> Exit:
    """Give a user another role, or disable or enable them."""
    wanted = read(UserChange, **asked)
    if isinstance(wanted, Refusal):
        return answer(wanted, as_json, str)

    def work(users: Users, _: Tokens) -> UserOut | Refusal:
        number = users.number_of(name)
        return number if isinstance(number, Refusal) else users.change(number, wanted)

    return answer(on_database(settings_of(data), work), as_json, _in_words)


def password(name: str, *, data: Path | None, as_json: bool) -> Exit:
    """Ask for a password and set it. Piped in, it is one line."""
    given = _ask()
    if isinstance(given, Refusal):
        return answer(given, as_json, str)
    return change(name, data=data, as_json=as_json, password=given)


def link(name: str, *, data: Path | None, as_json: bool) -> Exit:
    """Make a link that signs a user in once."""
    settings = settings_of(data)

    def work(users: Users, _: Tokens) -> Link | Refusal:
        number = users.number_of(name)
        made = number if isinstance(number, Refusal) else users.link(number)
        if isinstance(made, Refusal):
            return made
        return Link(path=made.path, expires_at=made.expires_at)

    return answer(
        on_database(settings, work),
        as_json,
        lambda made: f"Sign in once with: {_address(settings)}{made.path}",
    )


def _ask() -> str | Refusal:
    if not sys.stdin.isatty():
        return sys.stdin.readline().rstrip("\n")
    given = getpass("Password: ")
    if getpass("Once more: ") != given:
        return Refusal(Code.INVALID_REQUEST, "The two passwords differ: nothing was changed")
    return given


def _address(settings: Settings) -> str:
    """Where the console is by its settings; nobody knows a port that it took by itself."""
    if settings.port == 0:
        side_console().print("Put the address of the console before it.")
        return ""
    scheme = "http" if settings.tls_cert is None else "https"
    host = "localhost" if settings.host in ("0.0.0.0", "::") else settings.host
    return (
        f"{scheme}://[{host}]:{settings.port}"
        if ":" in host
        else (f"{scheme}://{host}:{settings.port}")
    )


def _in_words(user: UserOut) -> str:
    password = "with a password" if user.has_password else "without a password"
    return f"{user.name} is {_state(user)}, {password}"


def _state(user: UserOut) -> str:
    return f"{user.role.value}, disabled" if user.disabled else user.role.value


def _table(users: list[UserOut]) -> Table:
    table = Table("name", "role", "password", "last seen")
    for user in users:
        seen = "" if user.last_seen_at is None else f"{user.last_seen_at:%Y-%m-%d %H:%M} UTC"
        table.add_row(user.name, _state(user), "set" if user.has_password else "none", seen)
    return table
