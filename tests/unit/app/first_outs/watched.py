"""A keeper over a loop that does what a test says, without threads: `look` does all there is to do."""

from pathlib import Path

import numpy as np

from app.controller.settings import ControllerSettings
from app.db import Database
from app.first_outs import repository
from app.first_outs.book import Book
from app.first_outs.box import InForce
from app.first_outs.keeper import Following, Keeper
from app.first_outs.models import FirstOut
from app.first_outs.repository import Sought
from app.interlocks.defaults import default_interlocks
from app.link.life import Life
from rtcore.rig.parameters import load_rig

AROUND_TICKS = 8000
RING_S = 8.0


def in_force() -> InForce:
    """The settings as shipped."""
    return InForce(ControllerSettings(), default_interlocks(), load_rig(), seed=0)


class Watched:
    """A console's keeper as it starts, on the database and folder of those before it."""

    def __init__(self, life: Life, database: Database, folder: Path, most: int = 500) -> None:
        self.book = Book(database, folder, most)
        self.keeper = Keeper(self.book, in_force)
        self._following = Following(life, self.book)
        self._database = database
        self._folder = folder

    def look(self) -> None:
        """Look once, and keep what is full."""
        self.keeper.look(self._following)

    @property
    def kept(self) -> list[FirstOut]:
        """The first-outs in the book, oldest first."""
        with self._database.reading() as session:
            rows = repository.page(session, Sought(), 100, None)
            return [row for row in reversed(rows) if row.account]

    def ticks(self, number: int) -> list[int]:
        """The ticks in the box of a first-out."""
        import pyarrow.parquet as pq

        table = pq.read_table(self._folder / str(number) / "box.parquet")
        ticks = table["tick"].to_numpy()
        assert np.array_equal(table["force_n"].to_numpy(), ticks.astype(np.float32))
        return [int(tick) for tick in ticks]
