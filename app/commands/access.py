"""What `forcerig user …` and `forcerig token …` share: the data directory, and how they answer."""

import os
from collections.abc import Callable
from getpass import getuser
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError
from rich.table import Table
from sqlalchemy.exc import SQLAlchemyError

from app.access.book import Book
from app.access.passwords import Passwords
from app.access.tokens import Tokens
from app.access.users import Users
from app.audit.actor import Actor, acting
from app.audit.service import Audit
from app.commands.output import Exit, print_json, print_refusal, text_console
from app.db import Database
from app.errors import Code, Refusal
from app.settings import Settings

T = TypeVar("T")
Asked = TypeVar("Asked", bound=BaseModel)


def settings_of(data: Path | None) -> Settings:
    """The settings for a data directory, that of the environment where none is given."""
    return Settings() if data is None else Settings(data_dir=data)


def on_database(settings: Settings, work: Callable[[Users, Tokens], T]) -> T | Refusal:
    """Do something with the users and tokens of a data directory. A running console notices soon."""
    passwords = Passwords()
    try:
        settings.data_dir.mkdir(parents=True, exist_ok=True)
        database = Database(settings.database_address)
        try:
            database.upgrade()
            Audit(database, settings.data_dir).follow()
            book = Book(database)
            book.read()
            with acting(_who_types()):
                return work(Users(book, passwords), Tokens(book))
        finally:
            database.close()
    except (OSError, SQLAlchemyError) as error:
        first = str(error).partition("\n")[0]
        return Refusal(Code.DATABASE_UNAVAILABLE, f"Cannot use {settings.data_dir}: {first}")
    finally:
        passwords.close()


def _who_types() -> Actor:
    """Whoever may read and write the data needs no other right."""
    try:
        name = getuser()
    except (KeyError, OSError):  # a user without a name, in a container
        name = f"user {os.getuid()}"
    return Actor(name, "command line", f"uid:{os.getuid()}")


def read(kind: type[Asked], **given: object) -> Asked | Refusal:
    """What was asked for on the command line, checked as the interface checks it."""
    try:
        return kind.model_validate(given)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join(str(part) for part in first["loc"])
        return Refusal(Code.INVALID_REQUEST, f"{place}: {first['msg']}")


def answer(found: T | Refusal, as_json: bool, say: Callable[[T], str | Table]) -> Exit:
    """Print what was done, or why it was not. `say` gives the words."""
    if isinstance(found, Refusal):
        return print_refusal(found, as_json)
    if as_json:
        print_json(_plain(found))
    else:
        text_console().print(say(found), markup=False)
    return Exit.PASSED


def _plain(found: object) -> object:
    if isinstance(found, BaseModel):
        return found.model_dump(mode="json")
    if isinstance(found, list):
        return [_plain(one) for one in found]
    return found
