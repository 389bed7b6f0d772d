"""`forcerig audit`: exit codes that scripts can lean on."""

import json
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from typer.testing import CliRunner

from app.audit.head import HEAD_FILE
from app.audit.record import Entry, record
from app.audit.service import Audit
from app.cli import cli
from app.db import Database


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A data directory with three entries."""
    database = Database(f"sqlite:///{tmp_path / 'forcerig.sqlite'}")
    database.upgrade()
    Audit(database, tmp_path).follow()
    with database.writing() as session:
        for action in ("tests.create", "tests.save", "runs.start"):
            record(session, Entry(action, "hold [red]", "because"))
    database.close()
    return tmp_path


def ran(command: str, data: Path) -> tuple[int, str]:
    result = CliRunner().invoke(cli, ["audit", *command.split(), "--data", str(data)])
    return result.exit_code, result.stdout


def without_triggers(data: Path, statement: str) -> None:
    with closing(sqlite3.connect(data / "forcerig.sqlite")) as connection, connection:
        for name in ("changed", "removed"):
            connection.execute(f"DROP TRIGGER audit_never_{name}")
        connection.execute(statement)


def test_an_intact_chain_ends_with_0(data: Path) -> None:
    code, said = ran("verify", data)
    assert (code, said.splitlines()[0][:14]) == (0, "Intact: 3 rows")
    code, said = ran("verify --json", data)
    found = json.loads(said)
    assert (code, found["rows"], found["intact"], found["broken_id"]) == (0, 3, True, None)


def test_a_broken_one_ends_with_1_and_names_the_row(data: Path) -> None:
    without_triggers(data, "UPDATE audit SET why = 'to be safe' WHERE id = 2")
    code, said = ran("verify", data)
    assert code == 1
    assert said.startswith("Broken: Row 2 is not as it was entered")
    code, said = ran("verify --json", data)
    assert (code, json.loads(said)["broken_id"]) == (1, 2)


def test_one_without_its_end_ends_with_1(data: Path) -> None:
    without_triggers(data, "DELETE FROM audit WHERE id = 3")
    code, said = ran("verify", data)
    assert (code, HEAD_FILE in said) == (1, True)


def test_a_garbled_row_can_still_be_looked_at(data: Path) -> None:
    without_triggers(data, "UPDATE audit SET at = 'never', after = '{' WHERE id = 2")
    code, said = ran("list --json", data)
    assert (code, json.loads(said)[1]["at"], json.loads(said)[1]["after"]) == (0, "never", "{")
    assert ran("verify", data)[0] == 1


def test_where_there_is_none_it_ends_with_2(data: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    assert ran("verify", tmp_path / "empty")[0] == 2
    (data / "forcerig.sqlite").write_bytes(b"no database at all, but long enough to be looked into")
    code, said = ran("verify --json", data)
    assert (code, json.loads(said)["code"]) == (2, "invalid_request")
    assert not (tmp_path / "empty" / "forcerig.sqlite").exists()


def test_the_list_shows_the_newest_first_and_what_was_asked_for(data: Path) -> None:
    code, said = ran("list --json", data)
    assert (code, [entry["id"] for entry in json.loads(said)]) == (0, [3, 2, 1])
    _, said = ran("list --json --action tests --limit 1", data)
    assert [entry["action"] for entry in json.loads(said)] == ["tests.save"]
    _, said = ran("list --search crea", data)
    assert "tests.create" in said
    assert "hold [red]" in said
    assert "runs.start" not in said
