"""Every change that people make is in the audit, with what it was before and after."""

import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.access.principal import Role
from app.audit.entry import Act
from app.audit.record import take_notes
from app.catalogue.exchange import Library
from app.catalogue.saving import Saved
from app.catalogue.service import Catalogue
from app.catalogue.written import Reader
from app.db import Database
from app.errors import Code, Refusal
from app.histories.store import Store, import_history
from app.rigs.schemas import CommandRequest, RigCommand
from app.rigs.service import Rig
from app.runs import repository
from app.runs.schemas import RunAnnotation
from app.runs.service import Runs
from app.storage.retention import Retainer
from app.storage.schemas import RetentionChange
from tests.a_run import a_run
from tests.unit.app.audit.entries import rows
from tests.unit.app.catalogue.written_tests import YAML, entered, written


@pytest.fixture
def catalogue(database: Database, tmp_path: Path) -> Catalogue:
    return Catalogue(database, Reader(Store(tmp_path / "histories")))


@pytest.fixture
def noted() -> Iterator[list[Act]]:
    """What is noted, as it is noted."""
    taken: list[Act] = []
    take_notes(taken.append)
    yield taken
    take_notes(None)


def told(database: Database) -> list[tuple[str, str]]:
    return [(row["action"], row["target"]) for row in rows(database)]


def after(row: Any) -> Any:
    return json.loads(row["after"])


def test_a_new_test_is_entered_with_its_definition(
    catalogue: Catalogue, database: Database
) -> None:
    entered(catalogue, author="ada", comment="for the morning")
    (row,) = rows(database)
    assert (row["action"], row["target"], row["why"]) == (
        "tests.create",
        "morning-hold",
        "for the morning",
    )
    assert after(row) == {"revision": 1, "author": "ada", "definition": YAML}


def test_a_saved_test_is_entered_with_the_difference(
    catalogue: Catalogue, database: Database
) -> None:
    entered(catalogue)
    changed = YAML.replace("to_n: 1000", "to_n: 1500")
    catalogue.save("morning-hold", written(changed), Saved(), 1)
    catalogue.save("morning-hold", written(changed), Saved(), 2)  # nothing new
    catalogue.save("morning-hold", written(), Saved(), 1)  # refused
    row = rows(database)[1]
    assert told(database)[1:] == [("tests.save", "morning-hold")]
    assert json.loads(row["before"]) == {"revision": 1}
    lines = after(row)["difference"].splitlines()
    assert [line for line in lines if line[:2] in ("- ", "+ ")] != []
    assert any("to_n: 1500" in line for line in lines if line.startswith("+"))
    assert any("to_n: 1000" in line for line in lines if line.startswith("-"))


def test_what_becomes_of_a_test_is_entered_once(catalogue: Catalogue, database: Database) -> None:
    entered(catalogue)
    for archived in (True, True, False):
        catalogue.set_archived("morning-hold", archived)
    for tags in (["b", "a"], ["a", "b"], []):
        catalogue.set_tags("morning-hold", tags)
    actions = [action for action, _ in told(database)[1:]]
    assert actions == ["tests.archive", "tests.restore", "tests.tag", "tests.tag"]
    assert (rows(database)[-1]["before"], rows(database)[-1]["after"]) == ('["a", "b"]', "[]")


def test_imported_tests_are_entered_each(catalogue: Catalogue, database: Database) -> None:
    library = Library(database, catalogue.reader)
    library.enter({"one.yaml": YAML, "two.yaml": YAML})
    library.enter({"one.yaml": YAML + "# again\n"})
    assert told(database) == [
        ("tests.create", "one"),
        ("tests.create", "two"),
        ("tests.save", "one"),
    ]
    assert rows(database)[0]["why"] == "Imported from one.yaml"


def test_notes_of_a_run_are_entered_before_and_after(database: Database, tmp_path: Path) -> None:
    with database.writing() as session:
        run = a_run(session)
        run.conditions_id = repository.freeze(session, [])
        session.add(run)
    runs = Runs(database, tmp_path)
    runs.annotate(run.id, RunAnnotation(annotation=0, notes="odd", tags=("x",)))
    runs.annotate(run.id, RunAnnotation(annotation=0, notes="late"))  # refused
    (row,) = rows(database)
    assert (row["action"], row["target"]) == ("runs.annotate", f"run {run.id}")
    assert json.loads(row["before"]) == {"notes": "", "operator": "", "tags": []}
    assert after(row) == {"notes": "odd", "operator": "", "tags": ["x"]}


def test_the_rule_of_retention_is_entered(database: Database, tmp_path: Path) -> None:
    change = RetentionChange(keep_days=3, keep_bytes=None, keep_tags=["paper"], based_on=0)
    Retainer(database, tmp_path).change(change)
    (row,) = rows(database)
    assert row["action"] == "storage.rule"
    assert json.loads(row["before"])["keep_days"] is None
    assert after(row) == {"keep_days": 3.0, "keep_bytes": None, "keep_tags": ["paper"]}


def test_commands_are_noted_done_or_refused(noted: list[Act]) -> None:
    link: Any = SimpleNamespace(ask=lambda *_, **__: SimpleNamespace(tick=7), life=None)
    nobody: Any = Refusal(Code.STALE_LEASE, "Take command first")
    who: Any = SimpleNamespace(name="ada", role=Role.OPERATOR)
    reasons: Any = None
    leases = [1, nobody]
    rig = Rig(link, reasons, lambda *_: leases.pop(0))
    rig.command(who, CommandRequest(command=RigCommand.HOLD))
    rig.command(who, CommandRequest(command=RigCommand.TARE))
    assert [(act.action, act.outcome, act.why) for act in noted] == [
        ("rig.hold", "done", None),
        ("rig.tare", "refused: stale_lease", "Take command first"),
    ]
    assert noted[0].after == '{"tick": 7}'


def test_a_new_time_history_is_noted_once(noted: list[Act], tmp_path: Path) -> None:
    for _ in range(2):
        import_history([b"0\n1\n0\n"], "gust.csv", tmp_path, rate_hz=10.0)
    assert [(act.action, act.target) for act in noted] == [("histories.import", "gust.csv")]
