"""`forcerig user …` and `forcerig token …` on a data directory."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from app.access.book import Book
from app.access.keys import digest
from app.access.passwords import Passwords
from app.access.sessions import Sessions
from app.cli import cli
from app.db import Database
from app.settings import Settings

LONG = "correct horse battery"


class Prompt:
    """Types commands for one data directory."""

    def __init__(self, data: Path) -> None:
        self.data = data
        self.databases: list[Database] = []

    def __call__(self, *words: str, typed: str | None = None) -> Result:
        return CliRunner().invoke(cli, [*words, "--data", str(self.data)], input=typed)

    def json(self, *words: str, typed: str | None = None) -> Any:
        """What a command answers for programs."""
        done = self(*words, "--json", typed=typed)
        return json.loads(done.stdout)

    def book(self) -> Book:
        """What is in the directory now."""
        self.databases.append(Database(Settings(data_dir=self.data).database_address))
        book = Book(self.databases[-1])
        book.read()
        return book


@pytest.fixture
def prompt(tmp_path: Path) -> Iterator[Prompt]:
    made = Prompt(tmp_path / "data")
    yield made
    for database in made.databases:
        database.close()


def test_a_user_is_entered_changed_and_listed(prompt: Prompt) -> None:
    assert prompt("user", "add", "KL", "--role", "viewer").exit_code == 0
    assert prompt("user", "role", "KL", "engineer").exit_code == 0
    assert prompt("user", "disable", "KL").exit_code == 0
    (user,) = prompt.json("user", "list")
    assert (user["name"], user["role"], user["disabled"]) == ("KL", "engineer", True)
    assert prompt("user", "enable", "KL").exit_code == 0
    assert "engineer" in prompt("user", "list").stdout


def test_a_password_is_piped_in_and_fits(prompt: Prompt) -> None:
    prompt("user", "add", "KL")
    done = prompt("user", "password", "KL", typed=f"{LONG}\n")
    assert done.exit_code == 0
    assert LONG not in done.output
    user = prompt.book().user("KL")
    assert user is not None
    passwords = Passwords()
    assert passwords.is_right(LONG, user.password_hash)
    passwords.close()


def test_a_link_lets_in_where_the_console_is(prompt: Prompt) -> None:
    prompt("user", "add", "KL")
    said = prompt("user", "link", "KL").stdout.strip()
    address, _, key = said.partition("/sign-in?token=")
    assert address == "Sign in once with: http://127.0.0.1:8000"
    assert Sessions(prompt.book()).by_link(key) is not None


def test_a_token_is_printed_alone_and_once(prompt: Prompt) -> None:
    done = prompt("token", "create", "nightly", "--scope", "read", "--days", "2")
    token = done.stdout.strip()
    assert token.startswith("forcerig_")
    found = prompt.book().token(digest(token))
    assert found is not None
    assert (found.name, found.user.name, found.scope) == ("nightly", "admin", "read")
    assert token not in prompt("token", "list").output
    (listed,) = prompt.json("token", "list")
    assert "token" not in listed
    assert prompt("token", "revoke", str(listed["id"])).exit_code == 0
    assert prompt.book().token(digest(token)) is None


def test_a_token_holds_for_ever_only_where_somebody_says_so(prompt: Prompt) -> None:
    assert prompt.json("token", "create", "a")["expires_at"] is not None
    assert prompt.json("token", "create", "b", "--for-ever")["expires_at"] is None


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (("user", "role", "nobody", "admin"), "unknown_user"),
        (("user", "link", "nobody"), "unknown_user"),
        (("user", "add", "KL"), "user_exists"),
        (("user", "add", "../KL"), "invalid_request"),
        (("user", "disable", "admin"), "last_admin"),
        (("user", "role", "admin", "viewer"), "last_admin"),
        (("user", "password", "KL"), "weak_password"),
        (("token", "create", "x", "--user", "nobody"), "unknown_user"),
        (("token", "create", "x", "--user", "KL", "--scope", "admin"), "not_allowed"),
        (("token", "create", "x", "--days", "-1"), "invalid_request"),
        (("token", "revoke", "99"), "unknown_token"),
    ],
)
def test_what_is_refused_says_why_and_ends_with_2(
    prompt: Prompt, words: tuple[str, ...], code: str
) -> None:
    prompt("token", "create", "first")  # makes the admin
    prompt("user", "add", "KL")
    before = prompt.json("user", "list")
    done = prompt(*words, "--json", typed="short\n")
    assert done.exit_code == 2
    assert json.loads(done.stdout)["code"] == code
    assert done.stderr.strip()
    assert prompt.json("user", "list") == before


def test_a_directory_that_cannot_be_used_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    done = Prompt(tmp_path / "file" / "data")("user", "list")
    assert done.exit_code == 2
    assert "Cannot use" in done.stderr
