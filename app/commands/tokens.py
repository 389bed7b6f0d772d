"""`forcerig token …`."""

from datetime import datetime
from pathlib import Path

from rich.table import Table

from app.access.schemas import TokenCreate, TokenMade, TokenOut
from app.access.tokens import Tokens
from app.access.users import FIRST_ADMIN, Users
from app.commands.access import answer, on_database, read, settings_of
from app.commands.output import Exit, side_console
from app.errors import Refusal
from app.settings import Settings


def make_token(settings: Settings, owner: str, asked: TokenCreate) -> TokenMade | Refusal:
    """A new token in a data directory. The first admin is made where there is nobody yet."""

    def work(users: Users, tokens: Tokens) -> TokenMade | Refusal:
        if owner == FIRST_ADMIN:
            users.first_admin()
        number = users.number_of(owner)
        return number if isinstance(number, Refusal) else tokens.make_for(number, asked)

    return on_database(settings, work)


def create(
    name: str, owner: str, scope: str, days: float | None, *, data: Path | None, as_json: bool
) -> Exit:
    """Make a token and print it, this once."""
    asked = read(TokenCreate, name=name, scope=scope, expires_in_days=days)
    if isinstance(asked, Refusal):
        return answer(asked, as_json, str)
    return answer(make_token(settings_of(data), owner, asked), as_json, _say_made)


def show(*, data: Path | None, as_json: bool) -> Exit:
    """List all tokens."""
    return answer(on_database(settings_of(data), lambda _, tokens: tokens.all()), as_json, _table)


def revoke(token_id: int, *, data: Path | None, as_json: bool) -> Exit:
    """End a token."""

    def work(_: Users, tokens: Tokens) -> dict[str, int] | Refusal:
        return tokens.revoke(token_id) or {"revoked": token_id}

    done = f"Token {token_id} is revoked; a running console refuses it within two seconds"
    return answer(on_database(settings_of(data), work), as_json, lambda _: done)


def _say_made(made: TokenMade) -> str:
    until = "" if made.expires_at is None else f" until {_when(made.expires_at)}"
    side_console().print(
        f"Token {made.id} of {made.owner} for {made.scope.value}{until}. It is shown this once:",
        markup=False,
    )
    return made.token


def _table(tokens: list[TokenOut]) -> Table:
    table = Table("number", "name", "owner", "scope", "until", "last used", "revoked")
    for one in tokens:
        times = (one.expires_at, one.last_used_at, one.revoked_at)
        table.add_row(
            str(one.id), one.name, one.owner, one.scope.value, *(_when(time) for time in times)
        )
    return table


def _when(time: datetime | None) -> str:
    return "" if time is None else f"{time:%Y-%m-%d %H:%M} UTC"
