"""`forcerig user …` and `forcerig token …`, as typer sees them."""

from pathlib import Path
from typing import Annotated, Literal

import typer

users = typer.Typer(help="Who may come in. The console may be running.", no_args_is_help=True)
tokens = typer.Typer(help="Tokens for scripts. The console may be running.", no_args_is_help=True)

Role = Literal["viewer", "operator", "engineer", "admin"]
Scope = Literal["read", "operate", "engineer", "admin"]
Json = Annotated[bool, typer.Option("--json", help="One JSON document on standard output.")]
Data = Annotated[
    Path | None, typer.Option("--data", help="Where its state is kept.", show_default="data")
]
Name = Annotated[str, typer.Argument(help="Of the user.")]


@users.command("add")
def add_user(
    name: Name,
    role: Annotated[Role, typer.Option(help="What they may do.")] = "operator",
    data: Data = None,
    json: Json = False,
) -> None:
    """Enter a user. `link` or `password` lets them in."""
    from app.commands.users import add as run

    raise typer.Exit(run(name, role, data=data, as_json=json))


@users.command("list")
def list_users(data: Data = None, json: Json = False) -> None:
    """Show everybody."""
    from app.commands.users import show as run

    raise typer.Exit(run(data=data, as_json=json))


@users.command("role")
def change_role(name: Name, role: Role, data: Data = None, json: Json = False) -> None:
    """Give a user another role."""
    from app.commands.users import change as run

    raise typer.Exit(run(name, data=data, as_json=json, role=role))


@users.command("password")
def set_password(name: Name, data: Data = None, json: Json = False) -> None:
    """Set a password, asked for or piped in. The user's sessions end."""
    from app.commands.users import password as run

    raise typer.Exit(run(name, data=data, as_json=json))


@users.command("disable")
def disable_user(name: Name, data: Data = None, json: Json = False) -> None:
    """Let a user in no more."""
    from app.commands.users import change as run

    raise typer.Exit(run(name, data=data, as_json=json, disabled=True))


@users.command("enable")
def enable_user(name: Name, data: Data = None, json: Json = False) -> None:
    """Let a disabled user in again."""
    from app.commands.users import change as run

    raise typer.Exit(run(name, data=data, as_json=json, disabled=False))


@users.command("link")
def link_user(name: Name, data: Data = None, json: Json = False) -> None:
    """Print a link that signs a user in once, within a day."""
    from app.commands.users import link as run

    raise typer.Exit(run(name, data=data, as_json=json))


@tokens.command("create")
def create_token(
    name: Annotated[str, typer.Argument(help="What it is for.")],
    user: Annotated[str, typer.Option(help="Whose it is.")] = "admin",
    scope: Annotated[Scope, typer.Option(help="What it may do, up to its owner.")] = "operate",
    days: Annotated[float, typer.Option(help="How long it holds.")] = 90.0,
    for_ever: Annotated[bool, typer.Option("--for-ever", help="Until it is revoked.")] = False,
    data: Data = None,
    json: Json = False,
) -> None:
    """Make a token. It is printed this once."""
    from app.commands.tokens import create as run

    raise typer.Exit(run(name, user, scope, None if for_ever else days, data=data, as_json=json))


@tokens.command("list")
def list_tokens(data: Data = None, json: Json = False) -> None:
    """Show all tokens, without what makes them one."""
    from app.commands.tokens import show as run

    raise typer.Exit(run(data=data, as_json=json))


@tokens.command("revoke")
def revoke_token(
    number: Annotated[int, typer.Argument(help="As `list` shows it.")],
    data: Data = None,
    json: Json = False,
) -> None:
    """End a token."""
    from app.commands.tokens import revoke as run

    raise typer.Exit(run(number, data=data, as_json=json))
