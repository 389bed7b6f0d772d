"""The clerk says at once what was seen, however long it takes to file the run before."""

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from app.recording.clerk import Clerk
from app.recording.outcome import LOOP_ENDED, Ending
from app.recording.run_file import Recorded
from tests.unit.app.recording.paper_book import PaperBook

PATIENCE_S = 30.0
NOTHING = Recorded(-1, -1, 0, 0)


class SlowBook(PaperBook):
    """A book in which it takes as long as one likes to write the end of a run down."""

    def __init__(self) -> None:
        super().__init__()
        self.measuring, self.goes_on, self.heard = (threading.Event() for _ in range(3))

    def began(self, run_id: int, first_tick: int) -> None:
        super().began(run_id, first_tick)
        self.heard.set()

    def ended(self, run_id: int, recorded: Recorded, ending: Ending) -> None:
        self.measuring.set()
        assert self.goes_on.wait(PATIENCE_S)
        super().ended(run_id, recorded, ending)


@pytest.fixture
def book() -> Iterator[SlowBook]:
    made = SlowBook()
    yield made
    made.goes_on.set()


def test_a_run_has_begun_while_the_one_before_is_measured(book: SlowBook, tmp_path: Path) -> None:
    clerk = Clerk(tmp_path, book)
    clerk.start()
    for run_id in (1, 2):
        book.enter(run_id)
        (tmp_path / str(run_id)).mkdir()
    clerk.ended(1, NOTHING, LOOP_ENDED)
    assert book.measuring.wait(PATIENCE_S)
    clerk.began(2, 4000)
    assert book.heard.wait(PATIENCE_S)
    assert book.open[2].first_tick == 4000
    assert book.ends == {}
    book.goes_on.set()
    clerk.stop()
    assert list(book.ends) == [1]


def test_all_that_was_said_of_a_run_is_written_down_before_its_end(
    book: SlowBook, tmp_path: Path
) -> None:
    book.goes_on.set()
    clerk = Clerk(tmp_path, book)
    for run_id in range(1, 20):
        book.enter(run_id)
        (tmp_path / str(run_id)).mkdir()
        clerk.began(run_id, run_id)
        clerk.ended(run_id, NOTHING, LOOP_ENDED)
    clerk.start()
    clerk.stop()
    assert book.ended_in_order == list(range(1, 20))
