"""`forcerig` hands each command what it was given."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

import app.db
import app.main
import rtcore.doctor
from app.cli import cli

Calls = list[tuple[Any, ...]]


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Calls:
    made: Calls = []

    def noted(name: str, code: int = 0) -> Any:
        def call(*arguments: Any, **named: Any) -> int:
            made.append((name, *arguments, *(v for v in named.values() if v is not None)))
            return code

        return call

    monkeypatch.setattr(app.main, "serve", noted("serve"))
    monkeypatch.setattr(app.db, "upgrade", noted("upgrade"))
    monkeypatch.setattr(rtcore.doctor, "main", noted("doctor", 4))
    monkeypatch.delenv("FORCERIG_DATA_DIR", raising=False)
    return made


@pytest.mark.parametrize(
    ("arguments", "call", "code"),
    [
        ("serve", ("serve", None, None, None), 0),
        ("serve --host ::1 --port 0 --data d", ("serve", "::1", 0, Path("d")), 0),
        ("doctor", ("doctor", False), 4),
        ("doctor --json", ("doctor", True), 4),
        ("db upgrade", ("upgrade", Path("data")), 0),
        ("db upgrade --data d", ("upgrade", Path("d")), 0),
    ],
)
def test_a_command_is_handed_what_it_was_given(
    calls: Calls, arguments: str, call: tuple[Any, ...], code: int
) -> None:
    result = CliRunner().invoke(cli, arguments.split())
    assert result.exit_code == code, result.output
    assert calls == [call]


def test_an_unknown_option_ends_with_2_and_says_so(calls: Calls) -> None:
    result = CliRunner().invoke(cli, ["serve", "--prot", "1"])
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "--port" in result.stderr
    assert calls == []
