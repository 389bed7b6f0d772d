"""The wall clock jumps an hour, either way: nobody is put out of command or let in, and nothing is lost."""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta, tzinfo
from pathlib import Path
from typing import Any

import pytest

import app
from app.access.keys import digest
from app.access.passwords import Passwords
from app.access.principal import Principal, Role
from app.audit.service import Audit
from app.authority.lease import Wish
from app.authority.schemas import LeaseOut
from app.authority.service import Authority, Clock
from app.db import Database
from app.recording.outcome import Ending, Outcome
from app.recording.run_file import Recorded
from app.runs.ledger import Ledger
from app.runs.models import Run
from app.storage.retention import Retainer
from app.storage.schemas import RetentionChange, RetentionOut
from tests.unit.app.access.at_a_time import Desk
from tests.unit.app.audit.entries import do, rows, some
from tests.unit.app.storage.stored_runs import NOW, enter, files

HOUR = timedelta(hours=1)
JUMPS = pytest.mark.parametrize("jump", [HOUR, -HOUR])
ANN = Principal("session:1", "Ann", Role.OPERATOR, "session", 1)

# What times the rig, or who is in command of it, may not so much as look at the wall clock.
MONOTONIC = (
    *("rtcore", "app/link", "app/live", "app/recording", "app/stopping", "app/prediction"),
    *("app/access/attempts.py", "app/access/pace.py", "app/access/tickets.py"),
)
ROOT = Path(app.__file__).parent.parent


class Jumped(datetime):
    """The wall clock, an hour off."""

    jump = timedelta()

    @classmethod
    def now(cls, tz: tzinfo | None = None) -> Any:
        return datetime.now(tz) + cls.jump

    @classmethod
    def by(cls, jump: timedelta) -> type["Jumped"]:
        return type("Jumped", (cls,), {"jump": jump})


@pytest.fixture
def desk(database: Database) -> Iterator[Desk]:
    passwords = Passwords()
    passwords.open()
    made = Desk(database, passwords)
    yield made
    made.identity.close()
    passwords.close()


def looks_at_the_wall_clock(source: str) -> list[int]:
    """The lines that do."""
    asked = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Attribute)]
    wall = {("datetime", "now"), ("datetime", "utcnow"), ("time", "time"), ("time", "time_ns")}
    return [
        n.lineno for n in asked if isinstance(n.value, ast.Name) and (n.value.id, n.attr) in wall
    ]


def test_the_look_finds_it() -> None:
    assert looks_at_the_wall_clock("import time\nat = time.time()") == [2]
    assert looks_at_the_wall_clock("at = datetime.now(UTC)") == [1]
    assert looks_at_the_wall_clock("at = time.monotonic()") == []


@pytest.mark.parametrize("place", MONOTONIC)
def test_what_times_the_rig_never_looks_at_it(place: str) -> None:
    found = ROOT / place
    files = sorted(found.rglob("*.py")) if found.is_dir() else [found]
    assert files
    assert [(str(f), n) for f in files for n in looks_at_the_wall_clock(f.read_text())] == []


@dataclass
class Loop:
    """A loop that obeys."""

    epoch: int | None = 0

    def obey(self, epoch: int) -> None:
        self.epoch = epoch


@JUMPS
def test_whoever_is_in_command_stays_so_for_just_as_long(jump: timedelta) -> None:
    """And is shown with the time of day at which the console began, by its clock since then."""
    seconds = 1000.0
    clock = Clock(lambda: seconds, datetime(2026, 3, 1, tzinfo=UTC), seconds)
    authority = Authority(Loop(), lambda who: True, lambda change: None, clock)
    taken = authority.take(ANN, Wish("A test", ttl_s=10.0))
    assert isinstance(taken, LeaseOut)
    before = authority.shown()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("app.authority.service.datetime", Jumped.by(jump))
        assert authority.shown() == before
        seconds += 9.9
        assert authority.shown() is not None
        seconds += 0.2
        assert authority.shown() is None


@JUMPS
def test_a_console_that_starts_after_a_jump_goes_on_beyond_the_loops_epoch(jump: timedelta) -> None:
    """Its epochs begin with the time of day; those of a loop that is ahead are gone beyond."""
    loop = Loop()
    epochs = []
    for began in (datetime(2026, 3, 1, tzinfo=UTC), datetime(2026, 3, 1, tzinfo=UTC) + jump):
        authority = Authority(
            loop, lambda who: True, lambda change: None, Clock(lambda: 0.0, began, 0.0)
        )
        taken = authority.take(ANN, Wish("A test"))
        assert isinstance(taken, LeaseOut)
        epochs.append(taken.epoch)
    assert epochs[1] > epochs[0]
    assert loop.epoch == epochs[1]


@JUMPS
def test_who_is_in_stays_in_and_not_for_much_longer(desk: Desk, jump: timedelta) -> None:
    key = desk.sessions.begin(desk.enter("kl").id)
    assert desk.book.session(digest(key)) is not None
    desk.now += jump
    assert desk.book.session(digest(key)) is not None
    desk.book.note_seen()
    assert desk.book.session(digest(key)) is not None
    desk.wait(hours=13)
    assert desk.book.session(digest(key)) is None


@JUMPS
def test_an_audit_across_a_jump_is_in_order(
    database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, jump: timedelta
) -> None:
    """Its order is that of its numbers: the times in it are what the clock said."""
    audit = Audit(database, tmp_path)
    audit.follow()
    do(database, *some(2))
    monkeypatch.setattr("app.audit.entry.datetime", Jumped.by(jump))
    do(database, *some(2))
    assert audit.verify().intact
    assert [row.id for row in rows(database)] == [1, 2, 3, 4]


@JUMPS
def test_a_run_across_a_jump_has_its_own_duration(
    database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, jump: timedelta
) -> None:
    """Its length is counted in ticks."""
    run_id = enter(database, tmp_path, 0.0)
    ledger = Ledger(database, tmp_path, lambda subject: None, lambda: None)
    monkeypatch.setattr("app.runs.ledger.datetime", Jumped.by(jump))
    ledger.ended(run_id, Recorded(10, 4009, 4000, 0), Ending(Outcome.COMPLETED, None))
    with database.reading() as session:
        assert session.get_one(Run, run_id).duration_s == 1.0


@JUMPS
def test_samples_go_when_they_are_old_by_more_than_the_jump(
    database: Database, tmp_path: Path, jump: timedelta
) -> None:
    """A rule counts in days: an hour makes a run an hour older, and a clock set back takes nothing."""
    kept, old = (enter(database, tmp_path / "runs", age) for age in (29.9, 31.0))
    retainer = Retainer(database, tmp_path / "runs", lambda: NOW + jump)
    rule = retainer.rule()
    change = RetentionChange(based_on=rule.revision, keep_days=30, keep_bytes=None, keep_tags=[])
    assert isinstance(retainer.change(change), RetentionOut)
    retainer.apply()
    assert files(tmp_path / "runs", kept) > files(tmp_path / "runs", old)
