"""Whatever fails on the way to a start, no run stays under way that the loop has not begun."""

from contextlib import contextmanager
from pathlib import Path
from threading import Lock
from types import SimpleNamespace
from typing import Any

import pytest
from sqlalchemy.exc import OperationalError

from app.access.principal import Principal, Role
from app.audit.entry import Act
from app.audit.record import take_notes
from app.catalogue.service import StoredTest
from app.db import Database
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.errors import Code, Refusal
from app.runs import repository
from app.runs.entering import Frozen
from app.runs.models import Run
from app.runs.plans import Plans
from app.runs.schemas import RunStart
from app.runs.starting import Needs, Starter
from rtcore.codes import Opcode
from tests.a_prediction import a_prediction
from tests.unit.app.audit.entries import rows

WRONG_MODE = Refusal(Code.WRONG_MODE, "Cannot start: the rig is not in a state for that")


def _stored() -> StoredTest:
    blocks = [{"kind": "hold", "duration_s": 0.1}]
    found = definition_from({"schema": 1, "name": "hold", "blocks": blocks})
    assert isinstance(found, Definition)
    return StoredTest("hold", 1, "hold", found)


EPOCH = 7
ANN = Principal("session:1", "Ann", Role.OPERATOR, "session")


class Lab:
    """A starter over a book, with a loop that refuses to start, and a disk that can be taken away."""

    def __init__(self, folder: Path) -> None:
        self.database = Database(f"sqlite:///{folder / 'book.db'}")
        self.database.upgrade()
        self.given_up: list[int] = []
        self.answers: list[Any] = []
        self.locked = False
        self.stands = self.commands = True
        life = SimpleNamespace(name="1-42", period_ns=250_000, conditions=list)
        stored, predicted = _stored(), a_prediction()
        link: Any = SimpleNamespace(life=life, load_program=lambda p, lease: None, ask=self._ask)
        recorder: Any = SimpleNamespace(following=life)
        fakes: Any = SimpleNamespace(
            definition_of=lambda test_id, revision: stored,
            of=lambda definition, wait_s: predicted,
            stands=lambda definition, predicted: self.stands,
            refusal_for=lambda duration_s: None,
        )
        needs = Needs(
            fakes,
            fakes,
            fakes,
            self._in_command,
            lambda: None,
            self.given_up.append,
            lambda plan: None,
        )
        book: Any = SimpleNamespace(reading=self.database.reading, writing=self._writing)
        frozen = Frozen(controller={}, interlocks={}, rig={})
        self.starter = Starter(book, folder, link, recorder, lambda: frozen, Plans(), needs, Lock())

    def open_runs(self) -> list[int]:
        with self.database.reading() as session:
            return [run.id for run in repository.without_outcome(session)]

    def start(self) -> Run | Refusal:
        return self.starter.start(RunStart(test_id="hold"), ANN)

    def _in_command(self, who: Principal, lease: int | None) -> int | Refusal:
        return EPOCH if self.commands else Refusal(Code.LEASE_NEEDED, "Nobody is in command")

    def _ask(self, opcode: Opcode, argument: int, *, lease: int) -> Any:
        assert (opcode, lease) == (Opcode.START, EPOCH)
        return self.answers.pop(0)()

    @contextmanager
    def _writing(self) -> Any:
        if self.locked:
            raise OperationalError("BEGIN IMMEDIATE", None, Exception("database is locked"))
        with self.database.writing() as session:
            yield session


@pytest.fixture
def lab(tmp_path: Path) -> Lab:
    return Lab(tmp_path)


def test_a_start_that_the_loop_refuses_leaves_nothing(lab: Lab) -> None:
    lab.answers = [lambda: WRONG_MODE]
    assert lab.start() is WRONG_MODE
    assert lab.open_runs() == []


def test_a_start_is_in_the_audit_and_so_is_its_withdrawal(lab: Lab) -> None:
    noted: list[Act] = []
    take_notes(noted.append)
    lab.answers = [lambda: object(), lambda: WRONG_MODE]
    lab.start()
    lab.start()
    take_notes(None)
    told = [(row["action"], row["target"], row["why"]) for row in rows(lab.database)]
    assert told == [
        ("runs.start", "run 1", None),
        ("runs.start", "run 2", None),
        ("runs.withdraw", "run 2", WRONG_MODE.detail),
    ]
    (refused,) = noted
    assert (refused.action, refused.target) == ("runs.start", "hold")
    assert refused.outcome == "refused: wrong_mode"


def test_a_start_that_cannot_be_withdrawn_is_given_up_by_the_next(lab: Lab) -> None:
    def refuse_and_lock() -> Refusal:
        lab.locked = True
        return WRONG_MODE

    lab.answers = [refuse_and_lock, lambda: WRONG_MODE]
    with pytest.raises(OperationalError):
        lab.start()
    (left,) = lab.open_runs()
    lab.locked = False
    lab.start()
    assert lab.given_up == [left]


def test_a_run_that_the_loop_has_begun_is_not_given_up_by_the_next(lab: Lab) -> None:
    lab.answers = [lambda: object(), lambda: WRONG_MODE]
    run = lab.start()
    assert isinstance(run, Run)
    lab.start()
    assert lab.given_up == []


def test_who_is_not_in_command_starts_nothing(lab: Lab) -> None:
    lab.commands = False
    refusal = lab.start()
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.LEASE_NEEDED
    assert lab.open_runs() == []


def test_what_was_predicted_under_other_interlocks_is_not_started(lab: Lab) -> None:
    lab.stands = False
    refusal = lab.start()
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.BUSY
    assert "settings have changed" in refusal.detail
    assert lab.open_runs() == []
