"""Enters black boxes into the database, and keeps no more of them than there is room for."""

import logging
from pathlib import Path

from app.db import Database
from app.first_outs import files, repository
from app.first_outs.account import Account
from app.first_outs.models import FirstOut

_log = logging.getLogger(__name__)
MOST_KEPT = 500  # a megabyte each, nearly


class Book:
    """The first-outs of this data directory. What fails raises `OSError` or `SQLAlchemyError`."""

    def __init__(self, database: Database, folder: Path, most: int = MOST_KEPT) -> None:
        self._database = database
        self.folder = folder
        self._most = most

    def knows(self, loop_life: str, tick: int) -> bool:
        """Whether a first-out has been entered, removed since or not."""
        with self._database.reading() as session:
            return repository.is_known(session, loop_life, tick)

    def catch_up(self) -> None:
        """Enter what a kill left between writing a box and entering it."""
        with self._database.reading() as session:
            known = repository.numbers(session)
        files.give_back(self.folder, known)
        for waiting in files.waiting_boxes(self.folder):
            self.enter(waiting)

    def enter(self, waiting: Path) -> int | None:
        """Enter a box that has been set down; its number, or None where it was entered before."""
        account = files.account_in(waiting)
        with self._database.writing() as session:
            if repository.is_known(session, account.loop_life, account.tick):
                waiting.unlink()
                return None
            number = repository.enter(session, _row(account))
            files.put_in_place(waiting, self.folder, number)
        _log.warning("first-out %d: %s", number, account.first.text)
        self._let_go()
        return number

    def _let_go(self) -> None:
        """The oldest go first; what somebody has written something of stays."""
        with self._database.writing() as session:
            old = repository.beyond(session, self._most)
            gone = [row.id for row in old]
            for row in old:
                session.delete(row)
        for number in gone:
            files.take_out(self.folder, number)


def _row(account: Account) -> FirstOut:
    first = account.first
    return FirstOut(
        loop_life=account.loop_life,
        tick=account.tick,
        tripped_at=account.tripped_at,
        detector=first.detector,
        quantity=first.quantity,
        action=first.action,
        text=first.text,
        value=first.value,
        limit=first.limit,
        mode_before=account.mode_before,
        run_id=account.run_id,
        period_ns=account.period_ns,
        ticks=account.ticks,
        account=account.model_dump(mode="json"),
        note="",
        cause="",
    )
