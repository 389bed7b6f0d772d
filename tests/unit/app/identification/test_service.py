"""Identifications as a console has them: entered, worked on apart, kept, adopted, given up."""

import sqlite3
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from threading import Lock
from typing import Any

import pytest
from sqlalchemy.exc import OperationalError

from app.access.principal import Principal, Role
from app.audit import repository as audit
from app.audit.sought import Sought
from app.db import Database
from app.errors import Code, Refusal
from app.identification import queue
from app.identification.book import Book
from app.identification.models import Identification, State
from app.identification.requests import AdoptRequest, IdentificationOut, IdentificationRequest
from app.identification.schemas import Identified
from app.identification.service import CRASHED, Identifications
from app.recording.columns import as_batch
from app.recording.files import parquet_path
from app.recording.parquet import write_run
from app.revisions.kind import Preset
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.service import RIG_CONFIGURATION, RigConfigurations
from rtcore.rig.parameters import load_rig
from tests.a_run import a_run
from tests.console_process import wait_for
from tests.unit.app.identification.made_up import SHORT, Kept, recorded
from tests.unit.app.identification.test_recovery import off

ENGINEER = Principal("session:1", "Ada", Role.ENGINEER, "session")
PATHS = ("load_actuator.bypass_diameter_m", "servovalve.spool_gain_rad_s", "unit.k_tra")
WHY = "Fitted after the orifice was changed"
TRUE = off(dict.fromkeys(PATHS, 1.15))
QUICK = {"parameters": PATHS, "windows": 6, "candidates": 20}


class Twin:
    """A loop that takes any model."""

    def adopt(self, document: RigConfiguration, lease: int | None = None) -> Refusal | None:
        """It does."""
        return None

    def has(self, document: RigConfiguration) -> bool:
        """It has."""
        return True

    def give_later(self) -> None:
        """Never needed."""


@pytest.fixture(scope="module")
def kept() -> Kept:
    return recorded(TRUE, SHORT)


@pytest.fixture
def configurations(database: Database) -> RigConfigurations:
    preset = Preset(RigConfiguration())
    made = RigConfigurations(RIG_CONFIGURATION, database, Twin(), preset, Lock(), lambda _: None)
    made.open()
    return made


@pytest.fixture
def identifications(
    database: Database, configurations: RigConfigurations, tmp_path: Path
) -> Iterator[Identifications]:
    made = Identifications(database, tmp_path, configurations, lambda who, epoch: 1)
    yield made
    made.close()


def enter_run(database: Database, folder: Path, kept: Kept | None, **values: Any) -> int:
    """A run that is over, with its samples where they belong."""
    ticks = 0 if kept is None else len(kept.records)
    over: dict[str, Any] = {"outcome": "completed", "ticks": ticks, "ended_at": datetime.now(UTC)}
    with database.writing() as session:
        run = a_run(session, **(over | values))
        session.add(run)
        session.flush()
        number = run.id
    if kept is not None:
        (folder / str(number)).mkdir(parents=True)
        write_run(parquet_path(folder / str(number)), [as_batch(kept.records)], {})
    return number


def ended(identifications: Identifications, started: IdentificationOut | Refusal) -> Any:
    """An identification once it has an end."""
    assert isinstance(started, IdentificationOut), started

    def look() -> IdentificationOut | None:
        found = identifications.detail(started.id)
        assert isinstance(found, IdentificationOut)
        return found if found.ended_at is not None else None

    return wait_for(look, "the end of an identification")


def actions(database: Database) -> list[str]:
    with database.reading() as session:
        return [row.action for row in audit.page(session, Sought(), 100, None)]


@pytest.mark.process
@pytest.mark.slow
def test_a_model_is_fitted_apart_kept_and_adopted_as_a_revision(
    identifications: Identifications,
    configurations: RigConfigurations,
    database: Database,
    tmp_path: Path,
    kept: Kept,
) -> None:
    run = enter_run(database, tmp_path, kept)
    asked = IdentificationRequest.model_validate({"run_ids": [run], **QUICK})
    found = ended(identifications, identifications.start(ENGINEER, asked))
    assert (found.state, found.reason, found.share) == (State.DONE, None, 1.0)
    assert found.author == "Ada"
    assert [p.path for p in found.result.parameters] == list(PATHS)
    assert {w.run_id for w in found.result.windows} == {run}
    before = configurations.in_force

    adopted = identifications.adopt(ENGINEER, found.id, AdoptRequest(why=WHY))
    assert isinstance(adopted, IdentificationOut), adopted
    now = configurations.in_force
    assert adopted.adopted_revision == now.number == before.number + 1
    assert (now.author, now.why) == ("Ada", WHY)
    model = now.document.model
    assert model.load_actuator.bypass_diameter_m == pytest.approx(0.85e-3 * 1.15, rel=0.01)
    assert model.unit.k_tra == pytest.approx(60e6 * 1.15, rel=0.01)
    assert model.structure == load_rig().structure

    again = identifications.adopt(ENGINEER, found.id, AdoptRequest(why=WHY))
    assert isinstance(again, Refusal)
    assert again.code is Code.EDIT_CONFLICT
    kept_on = identifications.remove(found.id)
    assert kept_on is not None
    assert f"revision {now.number}" in kept_on.detail
    assert {"identifications.start", "identifications.adopt"} <= set(actions(database))


def stored(database: Database, state: State, **values: Any) -> int:
    """An identification as an earlier start has left it."""
    row = Identification(
        **{
            "state": state,
            "run_ids": [1],
            "fit": {"parameters": PATHS, "windows": 6, "candidates": 20},
            "based_on": 1,
            "model": load_rig().model_dump(mode="json"),
            "author": "Ada",
            "created_at": datetime.now(UTC),
            **values,
        }
    )
    with database.writing() as session:
        session.add(row)
        session.flush()
        return row.id


@pytest.mark.parametrize("state", [State.WAITING, State.RUNNING])
def test_what_a_console_left_in_its_midst_is_interrupted(
    identifications: Identifications, database: Database, state: State
) -> None:
    number = stored(database, state)
    identifications.open()
    found = identifications.detail(number)
    assert isinstance(found, IdentificationOut)
    assert (found.state, found.reason) == (State.INTERRUPTED, CRASHED)
    assert identifications.remove(number) is None
    assert isinstance(identifications.detail(number), Refusal)
    assert "identifications.remove" in actions(database)


@pytest.mark.process
@pytest.mark.slow
def test_one_that_nobody_wants_any_more_is_given_up(
    identifications: Identifications, database: Database, tmp_path: Path, kept: Kept
) -> None:
    run = enter_run(database, tmp_path, kept)
    asked = IdentificationRequest(run_ids=(run,))
    first, second = (identifications.start(ENGINEER, asked) for _ in range(2))
    assert isinstance(first, IdentificationOut)
    assert isinstance(second, IdentificationOut)
    busy = identifications.remove(second.id)
    assert busy is not None
    assert busy.code is Code.BUSY
    for started in (second, first):
        identifications.cancel(started.id)
    for started in (first, second):
        found = ended(identifications, started)
        assert (found.state, found.result) == (State.CANCELLED, None)
    nothing = identifications.adopt(ENGINEER, first.id, AdoptRequest(why=WHY))
    assert isinstance(nothing, Refusal)
    assert nothing.code is Code.NO_DATA


def test_runs_that_cannot_be_used_are_refused(
    identifications: Identifications, database: Database, tmp_path: Path
) -> None:
    under_way = enter_run(database, tmp_path, None, outcome=None, ended_at=None)
    empty = enter_run(database, tmp_path, None)
    here = enter_run(database, tmp_path, None, ticks=1)
    slower = enter_run(database, tmp_path, None, ticks=1, period_ns=500_000)
    cases = (
        ([999], Code.UNKNOWN_RUN),
        ([under_way], Code.RUN_UNDER_WAY),
        ([empty], Code.NO_DATA),
        ([here, here], Code.INVALID_REQUEST),
        ([here, slower], Code.INVALID_REQUEST),
    )
    for run_ids, code in cases:
        asked = IdentificationRequest.model_validate({"run_ids": run_ids})
        refused = identifications.start(ENGINEER, asked)
        assert isinstance(refused, Refusal), run_ids
        assert refused.code is code
    assert identifications.page(10, None) == []


def test_a_model_that_has_changed_since_is_not_written_over(
    identifications: Identifications, database: Database
) -> None:
    other = off({"structure.m_b_kg": 1.1})
    number = stored(database, State.DONE, model=other.model_dump(mode="json"), result={})
    refused = identifications.adopt(ENGINEER, number, AdoptRequest(why=WHY))
    assert isinstance(refused, Refusal)
    assert refused.code is Code.EDIT_CONFLICT
    assert "identify again" in refused.detail


def result() -> dict[str, Any]:
    """That the unit is stiffer by a twentieth."""
    before = load_rig().unit.k_tra
    fitted = {
        "path": "unit.k_tra",
        "title": "k",
        "unit": "N/m",
        "group": "unit",
        "before": before,
        "after": 1.05 * before,
        "low": before,
        "high": 1.1 * before,
        "half_percent": 5,
        "at_bound": False,
        "determined": True,
        "entangled": None,
    }
    return {
        "parameters": [fitted],
        "correlation": [[1]],
        "residuals": [],
        "force_zeros_n": [],
        "goodness": {"before_percent": None, "after_percent": None, "windows": 1},
        "windows": [],
        "iterations": 1,
        "settled": True,
        "took_s": 1,
        "notes": [],
    }


def test_an_adoption_that_cannot_be_written_down_leaves_the_model_as_it_was(
    identifications: Identifications,
    configurations: RigConfigurations,
    database: Database,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    number = stored(database, State.DONE, result=result())
    before = configurations.in_force

    def locked(*told: object) -> None:
        raise OSError("database is locked")

    with monkeypatch.context() as patched:
        patched.setattr(Book, "adopted", locked)
        with pytest.raises(OSError, match="locked"):
            identifications.adopt(ENGINEER, number, AdoptRequest(why=WHY))
    assert configurations.in_force == before
    assert isinstance(configurations.revision(before.number + 1), Refusal)
    adopted = identifications.adopt(ENGINEER, number, AdoptRequest(why=WHY))
    assert isinstance(adopted, IdentificationOut), adopted
    assert adopted.adopted_revision == configurations.in_force.number == before.number + 1
    assert isinstance(identifications.remove(number), Refusal)


def operational() -> OperationalError:
    return OperationalError("UPDATE", {}, sqlite3.OperationalError("database is locked"))


def test_an_end_that_finds_the_database_locked_is_written_down_once_it_is_not(
    database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    book = Book(database)
    number = stored(database, State.WAITING)
    found = Identified.model_validate(result())
    tries: list[int] = []

    def locked_twice(self: Book, number: int, found: Identified) -> None:
        tries.append(number)
        if len(tries) < 3:
            raise operational()
        done(self, number, found)

    done = Book.done
    monkeypatch.setattr(Book, "done", locked_twice)
    monkeypatch.setattr(queue, "AGAIN_S", 0.0)
    working = queue.Queue(book)
    working.put(number, lambda report, unwanted: found)
    wait_for(lambda: working.turn(number) is None or None, "the end of its turn")
    row = book.get(number)
    assert isinstance(row, Identification)
    assert (row.state, len(tries)) == (State.DONE, 3)
    assert row.result is not None
    working.close()


def test_one_under_way_that_has_no_turn_ends_when_it_is_given_up(
    identifications: Identifications, database: Database
) -> None:
    number = stored(database, State.RUNNING)
    found = identifications.cancel(number)
    assert isinstance(found, IdentificationOut)
    assert found.state is State.INTERRUPTED
    assert identifications.remove(number) is None


def test_every_parameter_is_told_with_its_value(identifications: Identifications) -> None:
    told = {p.path: p.value for p in identifications.parameters()}
    assert told["unit.k_tra"] == load_rig().unit.k_tra
    assert told["servovalve.null_m"] == 0.0
