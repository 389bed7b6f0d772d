"""Revisions of controller and rig configuration: what the loop has and what is stored are one, whatever fails."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Lock
from typing import Any

import pytest
from sqlalchemy import text
from sqlalchemy.exc import OperationalError

from app.controller.record import to_record as gains_record
from app.controller.service import CONTROLLER
from app.controller.settings import ControllerSettings
from app.db import Database
from app.errors import Code, Refusal
from app.revisions.book import RevisionBook
from app.revisions.kind import Kind, Preset, Revision, Wanted
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.loop_model import model_record
from app.rig_configuration.service import RIG_CONFIGURATION
from rtcore.codes import Opcode
from tests.unit.app.revisions.virtual_loop import VirtualBank


@dataclass(frozen=True)
class Case:
    """A kind of settings, its bank, and two documents that differ."""

    kind: Kind[Any]
    bank: tuple[Any, ...]
    first: Any
    other: Any


def of_rig(**parts: Any) -> RigConfiguration:
    return RigConfiguration.model_validate(parts)


CASES = {
    "controller": Case(
        CONTROLLER,
        ("gains", "active_gains", Opcode.ADOPT_GAINS, gains_record),
        ControllerSettings(),
        ControllerSettings.model_validate({"k_p": 9e-6, "compensator": "COMP8"}),
    ),
    "rig": Case(
        RIG_CONFIGURATION,
        (
            *("models", "active_model", Opcode.ADOPT_MODEL),
            lambda document: model_record(document.model),
        ),
        RigConfiguration(),
        of_rig(model={"load_actuator": {"bypass_diameter_m": 0.9e-3}}),
    ),
}


class Kept:
    """A book over a database that can be taken away, and a loop; `told` are the documents that were announced."""

    def __init__(self, case: Case, database: Database, loop: Any = None, **preset: Any) -> None:
        self.database = database
        self.loop = loop or VirtualBank(*case.bank)
        self.locked = False
        self.told: list[Any] = []
        self.case = case
        itself: Any = self
        given = Preset(preset.pop("document", case.first), **preset)
        self.book: RevisionBook[Any] = RevisionBook(
            case.kind, itself, self.loop, given, Lock(), self.told.append
        )
        self.book.open()

    def reading(self) -> Any:
        return self.database.reading()

    @contextmanager
    def writing(self) -> Iterator[Any]:
        with self.database.writing() as session:
            yield session
            if self.locked:
                raise OperationalError("COMMIT", None, Exception("the server has gone away"))

    def change(self, document: Any, based_on: int) -> Revision[Any] | Refusal:
        return self.book.change(Wanted(document, "Tried on the virtual rig", based_on, "Ann"))

    def stored(self) -> list[tuple[int, str, str]]:
        return [(row.number, row.author, row.why) for row in self.book.revisions(None, 100)]


@pytest.fixture(params=CASES, ids=list(CASES))
def kept(request: pytest.FixtureRequest, database: Database) -> Kept:
    found = Kept(CASES[request.param], database)
    assert found.loop.adopt(found.case.first) is None  # as the console gives it at the start
    return found


def test_a_change_is_in_the_loop_in_the_book_and_in_the_audit(kept: Kept) -> None:
    made = kept.change(kept.case.other, 1)
    assert isinstance(made, Revision)
    assert (made.number, made.author) == (2, "Ann")
    assert kept.loop.has(kept.case.other)
    assert not kept.loop.has(kept.case.first)
    assert kept.told == [kept.case.first, kept.case.other]
    with kept.database.reading() as session:
        row = session.execute(text("SELECT action, why FROM audit ORDER BY id DESC LIMIT 1")).one()
    assert tuple(row) == (kept.case.kind.action, "Tried on the virtual rig")
    assert Kept(kept.case, kept.database).book.in_force.document == kept.case.other


def test_who_comes_second_is_told_of_the_first(kept: Kept) -> None:
    kept.change(kept.case.other, 1)
    refusal = kept.change(kept.case.first, 1)
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.EDIT_CONFLICT
    assert f"Ann put revision 2 of the {kept.case.kind.name} in force" in refusal.detail


def test_what_the_loop_refuses_leaves_all_as_it_was(kept: Kept) -> None:
    kept.loop.rig.bring_to_ready()
    kept.loop.dead = isinstance(kept.case.first, ControllerSettings)  # gains may change when ready
    refusal = kept.change(kept.case.other, 1)
    assert isinstance(refusal, Refusal)
    assert refusal.code in (Code.WRONG_MODE, Code.LOOP_LOST)
    assert len(kept.stored()) == 1
    assert kept.told == [kept.case.first]
    assert kept.loop.has(kept.case.first)


def test_what_cannot_be_stored_is_taken_back_from_the_loop(kept: Kept) -> None:
    kept.locked = True
    with pytest.raises(OperationalError):
        kept.change(kept.case.other, 1)
    assert kept.loop.has(kept.case.first)
    assert kept.book.in_force.number == 1
    assert kept.told == [kept.case.first]


def test_a_console_that_dies_between_loop_and_book_comes_back_with_what_is_stored(
    kept: Kept,
) -> None:
    assert kept.loop.adopt(kept.case.other) is None  # and there it was killed
    again = Kept(kept.case, kept.database, kept.loop)
    assert again.book.in_force.document == kept.case.first
    assert not again.book.loop_has_it()  # which the page says, until the loop is given it


def test_a_file_that_differs_is_a_revision_of_the_console(kept: Kept) -> None:
    given = {"document": kept.case.other, "file": "mine.yaml"}
    started = Kept(kept.case, kept.database, **given)
    assert started.stored()[0] == (2, "console", "From the file mine.yaml")
    assert len(Kept(kept.case, kept.database, **given).stored()) == 2  # it is in force already


def test_an_earlier_revision_comes_back_as_a_new_one(kept: Kept) -> None:
    kept.change(kept.case.other, 1)
    first = kept.book.revision(1)
    assert isinstance(first, Revision)
    again = kept.change(first.document, 2)
    assert isinstance(again, Revision)
    assert (again.number, kept.loop.has(kept.case.first)) == (3, True)
    beyond = kept.book.revision(9)
    assert isinstance(beyond, Refusal)
    assert "no revision 9: the newest is 3" in beyond.detail
