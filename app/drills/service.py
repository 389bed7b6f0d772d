"""The drills: which can be given now, giving one, taking faults back, and the records of those given."""

import logging
import time
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from threading import Lock

from sqlalchemy.exc import SQLAlchemyError

from app.access.principal import Principal
from app.audit.entry import Entry
from app.audit.record import note
from app.authority.service import InCommand
from app.db import Database
from app.drills import files, repository
from app.drills.book import Book
from app.drills.drills import DRILL, DRILLS, Drill
from app.drills.models import UNDER_WAY, DrillGiven
from app.drills.schemas import (
    ClearRequest,
    DrillCatalogue,
    DrillDetail,
    DrillOut,
    DrillPage,
    DrillRequest,
    DrillSummary,
)
from app.drills.scoring import Limits, reaction_of, score
from app.drills.watching import Given, Watch, Watched
from app.errors import Code, Fault, Refusal
from app.link.life import Life
from app.link.link import Link
from app.runs.samples import known_channels, window_of
from app.runs.schemas import RunSamples
from rtcore.codes import Opcode
from rtcore.modes import Mode

_log = logging.getLogger(__name__)
_ATTEMPTS, _AGAIN_S = 20, 0.25
_CRASHED = "The console ended in the middle of it"
_LOST = Refusal(
    Code.LOOP_LOST, "The loop process does not run: wait until it is back, then press Reset"
)


class Drills:
    """One drill at a time. `names` are those of the detectors in force, in order."""

    def __init__(
        self,
        database: Database,
        folder: Path,
        link: Link,
        in_command: InCommand,
        names: Callable[[], Sequence[str]],
        limits: Limits,
    ) -> None:
        self._database = database
        self._folder = folder
        self._book = Book(database, folder)
        self._link = link
        self._in_command = in_command
        self._names = names
        self._limits = limits
        self._watch: Watch | None = None
        self._giving = Lock()

    def open(self) -> None:
        """What an earlier start has left: its drill has no end, and its faults may still be there."""
        self._book.interrupt_all(_CRASHED)
        life = self._link.life
        if life is not None and life.alive and life.injected():
            self._take_back()

    def close(self) -> None:
        """Leave no fault behind: the loop may outlive this console."""
        if (watch := self._watch) is not None:
            watch.interrupt("The console was ended in the middle of it")

    def catalogue(self) -> DrillCatalogue:
        """All drills, and why one cannot be given now."""
        life, watch = self._link.life, self._watch
        return DrillCatalogue(
            drills=[DrillOut.of(drill, self._why_not(drill, life)) for drill in DRILLS],
            under_way=None if watch is None else watch.given.number,
            injected=_injected(life),
        )

    def give(self, who: Principal, asked: DrillRequest) -> DrillDetail | Refusal:
        """Give a drill; it is under way when this returns, and scored when all has been seen."""
        with self._giving:
            given = self._give(who, asked)
        if isinstance(given, Refusal):
            note(Entry("drills.give", asked.fault, given.detail, refused=given.code))
            return given
        return self.detail(given)

    def clear(self, who: Principal, asked: ClearRequest) -> DrillCatalogue | Refusal:
        """Take all faults back; a drill under way ends without a score."""
        lease = self._in_command(who, asked.lease)
        if isinstance(lease, Refusal):
            return lease
        before = _injected(self._link.life)
        if (watch := self._watch) is not None:
            watch.interrupt(f"{who.name} took the fault back")
        answer = self._link.ask(Opcode.CLEAR_FAULTS, lease=lease)
        if isinstance(answer, Refusal):
            return answer
        note(Entry("drills.clear", "rig", before=before, after={}))
        return self.catalogue()

    def page(self, fault: str | None, limit: int, before: int | None) -> DrillPage:
        """The newest drills, or those before a number."""
        with self._database.reading() as session:
            rows = repository.page(session, fault, limit + 1, before)
            shown = [DrillSummary.of(row) for row in rows[:limit]]
        return DrillPage(records=shown, next=shown[-1].id if len(rows) > limit else None)

    def detail(self, number: int) -> DrillDetail | Refusal:
        """A drill with its score."""
        with self._database.reading() as session:
            row = repository.get(session, number)
            if row is None:
                return _unknown(number)
            expected = reaction_of(DRILL[row.fault], Mode[row.mode_before.upper()])
            return DrillDetail.with_score(row, expected)

    def window(
        self, number: int, channels: Sequence[str], from_s: float, to_s: float | None, points: int
    ) -> RunSamples | Refusal:
        """Minimum and maximum of channels in at most `points` stretches; times from the fault."""
        names = known_channels(channels)
        if isinstance(names, Refusal):
            return names
        found = self.detail(number)
        if isinstance(found, Refusal):
            return found
        samples = files.samples_of(self._folder, number)
        if samples is None or found.tick is None:
            return Refusal(Code.NO_DATA, f"Drill {number} has no samples")
        return window_of(samples, names, found.tick, found.period_s, from_s, to_s, points)

    def _why_not(self, drill: Drill, life: Life | None) -> str | None:
        mode = life.mode() if life is not None and life.alive else None
        if mode is None:
            return _LOST.detail
        if self._watch is not None:
            return "A drill is under way: wait until it is scored, or take its fault back"
        if reaction_of(drill, mode) is not None:
            return None
        if drill.ready is None:
            return "This drill needs a load: start a test first"
        return "This drill needs a rig that is ready, or a test that runs"

    def _give(self, who: Principal, asked: DrillRequest) -> int | Refusal:
        drill = DRILL.get(asked.fault)
        if drill is None:
            return _invalid("fault", asked.fault, f"one of {', '.join(DRILL)}")
        kind = drill.kind
        amount = kind.default if asked.amount is None else asked.amount
        if not kind.low <= amount <= kind.high or amount == 0.0:
            return _invalid("amount", amount, f"{kind.low:g} to {kind.high:g} {kind.unit}, not 0")
        lease = self._in_command(who, asked.lease)
        if isinstance(lease, Refusal):
            return lease
        life = self._link.life
        why_not = self._why_not(drill, life)
        if life is None or why_not is not None:
            busy = Code.BUSY if self._watch is not None else Code.WRONG_MODE
            alive = life is not None and life.alive
            return Refusal(busy, f"Cannot give this drill: {why_not}") if alive else _LOST
        return self._start(drill, amount, lease, life, who)

    def _start(
        self, drill: Drill, amount: float, lease: int, life: Life, who: Principal
    ) -> int | Refusal:
        record = life.snapshot()
        assert record is not None
        mode, run = Mode(int(record["mode"])), int(record["run"])
        reaction = reaction_of(drill, mode)
        if reaction is None:
            return Refusal(Code.WRONG_MODE, "Cannot give this drill: the rig has just changed")
        row = DrillGiven(
            fault=drill.name,
            amount=amount,
            state=UNDER_WAY,
            mode_before=mode.name.lower(),
            given_by=who.name[:200],
            given_at=datetime.now(UTC),
            loop_life=life.name,
            period_ns=life.period_ns,
            run_id=run or None,
            ticks=0,
        )
        number = self._book.enter(row)
        answer = self._link.ask(Opcode.INJECT_FAULT, drill.fault, value=amount, lease=lease)
        if isinstance(answer, Refusal):
            if answer.code is Code.LOOP_SILENT:
                self._take_back()  # it may have taken the fault, and said so too late
            self._book.withdraw(number)
            return answer
        watch = Watch(
            Given(number, drill, reaction, answer.tick, mode, life, self._names()), self._over
        )
        self._watch = watch
        watch.start()
        try:
            self._book.given(number, answer.tick)
        except SQLAlchemyError:
            watch.interrupt("The database did not answer")
            raise
        return number

    def _over(self, watch: Watch, found: Watched | str) -> None:
        """From the watch's thread: mend the rig first, then write down what was seen."""
        try:
            self._take_back()
            given = watch.given
            if isinstance(found, str):
                self._book.interrupted(given.number, found)
            else:
                scored = score(given.drill, given.reaction, found.seen, self._limits)
                self._book.scored(given.number, found, scored)
        except Exception:
            _log.exception("drill %d", watch.given.number)
        finally:
            self._watch = None

    def _take_back(self) -> None:
        """Clear all faults. Tried again: the loop may be stalled, or command just changing hands."""
        for _ in range(_ATTEMPTS):
            answer = self._link.ask(Opcode.CLEAR_FAULTS)
            life = self._link.life
            if not isinstance(answer, Refusal) or life is None or life.ended:
                return  # a loop that has ended takes its faults along
            _log.warning("the faults were not taken back: %s", answer.detail)
            time.sleep(_AGAIN_S)


def _injected(life: Life | None) -> dict[str, float]:
    if life is None or not life.alive:
        return {}
    return {fault.name.lower(): amount for fault, amount in life.injected().items()}


def _invalid(path: str, value: object, expected: str) -> Refusal:
    return Refusal(
        Code.INVALID_REQUEST, f"{path}: must be {expected}", (Fault(path, value, expected),)
    )


def _unknown(number: int) -> Refusal:
    return Refusal(Code.UNKNOWN_DRILL, f"There is no drill {number}")
