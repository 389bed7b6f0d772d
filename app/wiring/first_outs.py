"""What tripped the loop: kept as it happens, read, and run once more."""

from collections.abc import Callable
from pathlib import Path

from app.db import Database
from app.first_outs.again import Again
from app.first_outs.book import Book
from app.first_outs.box import InForce
from app.first_outs.keeper import Keeper
from app.first_outs.reruns import Reruns
from app.first_outs.run_tests import TestsOfRuns
from app.first_outs.service import FirstOuts
from app.histories.store import Store


class FirstOutRecords:
    """The keeper of first-outs, and the services over what it has kept."""

    def __init__(
        self, database: Database, folder: Path, histories: Store, in_force: Callable[[], InForce]
    ) -> None:
        self.keeper = Keeper(Book(database, folder), in_force)
        self.kept = FirstOuts(database, folder, lambda: self.keeper.trouble)
        self._reruns = Reruns(TestsOfRuns(database, histories).definition)
        self.again = Again(self.kept, self._reruns)

    def give_up(self) -> None:
        """End what is being run once more; first-outs are kept still."""
        self._reruns.close()
