"""Revisions of the table: what the loop has and what is stored are one and the same, whatever fails."""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Any

import pytest
from sqlalchemy import text
from sqlalchemy.exc import OperationalError

from app.db import Database
from app.documents.writing import to_data
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.service import INTERLOCKS, InterlockTables, Preset, Revision, Wanted
from app.interlocks.table import Interlocks
from rtcore.codes import Opcode
from tests.unit.app.interlocks.test_safeguards import table
from tests.unit.app.interlocks.virtual_loop import VirtualLoop

SHIPPED = default_interlocks()
GENTLER = table("force", threshold=30e3)
OTHER = table("displacement", threshold=0.02)


class Rig:
    """Tables over a database that can be taken away, and a loop; `told` are the tables that were announced."""

    def __init__(self, database: Database, preset: Preset[Interlocks] | None = None) -> None:
        self.database = database
        self.loop = VirtualLoop()
        self.locked = self.loop_dies_too = False
        self.told: list[Interlocks] = []
        book: Any = self
        preset = preset or Preset(SHIPPED)
        self.tables = InterlockTables(INTERLOCKS, book, self.loop, preset, Lock(), self.told.append)
        self.tables.open()

    def reading(self) -> Any:
        return self.database.reading()

    @contextmanager
    def writing(self) -> Iterator[Any]:
        with self.database.writing() as session:
            yield session
            self.loop.dead = self.loop_dies_too
            if self.locked:
                raise OperationalError("COMMIT", None, Exception("the server has gone away"))

    def change(
        self, wanted: Interlocks, based_on: int, why: str = "Softer unit"
    ) -> Revision[Interlocks] | Refusal:
        return self.tables.change(Wanted(wanted, why, based_on, "Ann"))

    def stored(self) -> list[tuple[int, str, str]]:
        return [(row.number, row.author, row.why) for row in self.tables.revisions(None, 100)]


@pytest.fixture
def rig(database: Database) -> Rig:
    return Rig(database)


def refused(answer: Revision[Interlocks] | Refusal) -> Refusal:
    assert isinstance(answer, Refusal)
    return answer


def test_the_first_start_puts_the_shipped_table_in_force(rig: Rig) -> None:
    assert rig.stored() == [(1, "console", "As shipped")]
    assert rig.tables.in_force.document == SHIPPED
    assert rig.told == [SHIPPED]
    assert Rig(rig.database).stored() == rig.stored()  # the second start


def test_a_change_is_in_the_loop_in_the_book_and_in_the_audit(rig: Rig) -> None:
    made = rig.change(GENTLER, 1)
    assert isinstance(made, Revision)
    assert (made.number, made.author, made.why) == (2, "Ann", "Softer unit")
    assert rig.loop.has(GENTLER)
    assert rig.tables.loop_has_it()
    assert rig.told[-1] == GENTLER
    with rig.database.reading() as session:
        row = session.execute(
            text("SELECT action, why, before, after FROM audit ORDER BY id DESC LIMIT 1")
        ).one()
    assert (row.action, row.why) == ("interlocks.change", "Softer unit")
    for kept, wanted in ((row.before, SHIPPED), (row.after, GENTLER)):
        assert '"force"' in str(kept).replace("'", '"')
        assert str(wanted.detectors[0].threshold) in str(kept)
    after = Rig(rig.database)  # the next start
    assert after.tables.in_force.document == GENTLER


def test_who_comes_second_is_told_of_the_first(rig: Rig) -> None:
    rig.change(GENTLER, 1)
    refusal = refused(rig.change(OTHER, 1))
    assert refusal.code is Code.EDIT_CONFLICT
    assert refusal.about["current_revision"] == 2
    assert "Ann put revision 2" in refusal.detail
    assert rig.loop.has(GENTLER)


def test_the_same_again_is_no_revision(rig: Rig) -> None:
    made = rig.change(SHIPPED, 1)
    assert isinstance(made, Revision)
    assert made.number == 1
    assert len(rig.stored()) == 1


def test_what_the_loop_refuses_is_not_stored(rig: Rig) -> None:
    rig.loop.start_a_run()
    assert refused(rig.change(GENTLER, 1)).code is Code.WRONG_MODE
    assert (len(rig.stored()), rig.told) == (1, [SHIPPED])
    assert rig.loop.has(SHIPPED)


def test_without_a_loop_nothing_is_stored(rig: Rig) -> None:
    rig.loop.dead = True
    assert refused(rig.change(GENTLER, 1)).code is Code.LOOP_LOST
    assert len(rig.stored()) == 1


def test_what_cannot_be_stored_is_taken_back_from_the_loop(rig: Rig) -> None:
    rig.locked = True
    with pytest.raises(OperationalError):
        rig.change(GENTLER, 1)
    assert rig.loop.has(SHIPPED)
    assert rig.tables.in_force.number == 1
    assert rig.told == [SHIPPED]
    rig.locked = False
    assert len(rig.stored()) == 1
    assert isinstance(rig.change(GENTLER, 1), Revision)


def test_a_loop_that_cannot_take_it_back_is_given_it_later(rig: Rig) -> None:
    rig.locked = rig.loop_dies_too = True
    with pytest.raises(OperationalError):
        rig.change(GENTLER, 1)
    assert rig.loop.owed == 1
    assert rig.tables.in_force.document == SHIPPED


def test_what_is_weaker_needs_a_word_and_a_stale_lease_is_refused_by_the_loop(rig: Rig) -> None:
    without = table("app_silence")
    assert refused(rig.change(without, 1)).code is Code.INTERLOCKS_WEAKENED
    assert rig.loop.has(SHIPPED)
    rig.loop.rig.command(Opcode.TAKE_LEASE, lease=7)
    stale = rig.tables.change(Wanted(GENTLER, "why", 1, "Ann", lease=6))
    assert refused(stale).detail == "stale_lease"
    assert isinstance(rig.tables.change(Wanted(GENTLER, "why", 1, "Ann", lease=7)), Revision)
    said = without.model_copy(update={"knowingly_weaker": ("app_silence",)})
    assert isinstance(rig.change(said, 2), Revision)


def test_an_old_revision_is_restored_by_giving_it_again(rig: Rig) -> None:
    rig.change(GENTLER, 1)
    first = rig.tables.revision(1)
    assert isinstance(first, Revision)
    again = rig.change(first.document, 2, "As it was")
    assert isinstance(again, Revision)
    assert again.number == 3
    assert rig.loop.has(SHIPPED)
    assert [number for number, _, _ in rig.stored()] == [3, 2, 1]
    assert [row.number for row in rig.tables.revisions(3, 1)] == [2]


def test_revision_0_is_the_one_as_shipped_and_there_is_none_beyond_the_newest(rig: Rig) -> None:
    rig.change(GENTLER, 1)
    zero = rig.tables.revision(0)
    assert isinstance(zero, Revision)
    assert zero.document == SHIPPED
    beyond = rig.tables.revision(9)
    assert isinstance(beyond, Refusal)
    assert beyond.detail == "The interlocks have no revision 9: the newest is 2"


def test_a_file_that_differs_is_a_revision_of_the_console(rig: Rig) -> None:
    rig.change(OTHER, 1)
    preset = Preset(GENTLER, "mine.yaml")
    started = Rig(rig.database, preset)
    assert started.stored()[0] == (3, "console", "From the file mine.yaml")
    assert started.tables.in_force.document == GENTLER
    assert len(Rig(rig.database, preset).stored()) == 3  # it is in force already


def test_a_revision_that_cannot_be_read_any_more_makes_room_for_the_shipped_one(rig: Rig) -> None:
    document = to_data(GENTLER)
    document["detectors"][0]["quantity"] = "sensor_faults"
    rig.change(GENTLER, 1)
    with rig.database.writing() as session:
        row = session.merge(rig.tables.revisions(None, 1)[0])
        row.document = document
    started = Rig(rig.database)
    assert started.tables.in_force.document == SHIPPED
    assert started.stored()[0][2] == "As shipped: revision 2 cannot be read any more"
