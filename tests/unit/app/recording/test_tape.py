"""Which ticks are of which run, and how each run ended, whoever died meanwhile."""

from pathlib import Path

import numpy as np
import pytest

from app.recording.outcome import Outcome
from app.recording.parts import part_paths
from rtcore.codes import EventKind, Opcode
from rtcore.modes import Mode
from tests.unit.app.recording.paper_book import Desk, PaperBook, recorded_ticks
from tests.written_block import APP_SILENCE, FORCE_HINT, WrittenBlock

LONGER_THAN_THE_RING = 9000
TAIL_TICKS = 2000  # half a second is recorded after a trip


@pytest.fixture
def loop() -> WrittenBlock:
    return WrittenBlock()


@pytest.fixture
def book() -> PaperBook:
    return PaperBook()


def test_a_run_is_recorded_from_its_first_tick_to_its_last(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.whole_run(1, 1000)
    desk.drain()
    recorded, ending = book.ends[1]
    assert (recorded.first_tick, recorded.last_tick) == (10, 1009)
    assert (recorded.ticks, recorded.missing_ticks) == (1000, 0)
    assert (ending.outcome, ending.reason) == (Outcome.COMPLETED, None)
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(10, 1010))
    assert book.kinds(1) == ["mode", "command", "program_ended", "mode", "mode"]
    assert part_paths(tmp_path / "1") == []


def test_it_does_not_matter_where_the_drains_fall(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    for ticks in (3, 1, 40):
        loop.ticks(ticks)
        desk.drain()
    loop.begin(1)
    for ticks in (1, 7, 500, 1):
        loop.ticks(ticks, run=1)
        desk.drain()
        assert book.ends == {}
    loop.obey(Opcode.STOP)
    loop.go(Mode.STOPPING)
    desk.drain()
    loop.ticks(5, run=1)
    desk.drain()
    loop.go(Mode.READY)
    desk.drain()
    assert book.ends == {}
    loop.ticks(1)
    desk.drain()
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(44, 44 + 514))
    assert book.ends[1][1].outcome is Outcome.STOPPED


def test_runs_in_one_drain_are_kept_apart(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    for run in (1, 2, 3):
        book.enter(run)
        loop.whole_run(run, 100)
    desk.drain()
    assert book.ended_in_order == [1, 2, 3]
    for run in (1, 2, 3):
        first = 10 + 120 * (run - 1)
        assert np.array_equal(recorded_ticks(tmp_path, run), np.arange(first, first + 100))
        assert book.ends[run][1].outcome is Outcome.COMPLETED
        assert book.kinds(run) == ["mode", "command", "program_ended", "mode", "mode"]


def test_an_app_that_was_killed_goes_on_where_it_was(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.ticks(10)
    loop.begin(1)
    loop.ticks(300, run=1)
    desk.drain()
    desk.kill()
    loop.ticks(700, run=1)  # nobody is there
    loop.trip(APP_SILENCE, 0.5001, 0.5)
    loop.go(Mode.STOPPING)
    loop.ticks(100, run=1)
    after = Desk(loop, tmp_path, book)
    after.drain()
    after.end_unseen()
    loop.ticks(50, run=1)
    loop.go(Mode.TRIPPED)
    loop.ticks(20, run=1)
    loop.ticks(1)
    after.drain()
    recorded, ending = book.ends[1]
    assert recorded.missing_ticks == 0
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(10, 10 + 1170))
    assert ending.outcome is Outcome.TRIPPED
    assert ending.reason == "Console silent for 0.50 s, limit 0.50 s"
    assert book.kinds(1) == ["mode", "command", "trip", "mode", "mode"]


def test_a_run_whose_end_was_missed_by_a_killed_app_is_closed_by_the_next(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.ticks(10)
    loop.begin(1)
    loop.ticks(95, run=1)
    desk.drain()
    desk.kill()
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(10)
    after = Desk(loop, tmp_path, book)
    after.drain()
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(10, 105))
    assert book.ends[1][1].outcome is Outcome.COMPLETED


def test_a_start_that_the_killed_app_never_saw_answered_is_recorded(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    Desk(loop, tmp_path, book)
    book.enter(7)
    loop.whole_run(7, 100)
    after = Desk(loop, tmp_path, book)
    after.drain()
    after.end_unseen()
    assert np.array_equal(recorded_ticks(tmp_path, 7), np.arange(10, 110))
    assert book.ends[7][1].outcome is Outcome.COMPLETED


def test_a_run_whose_beginning_was_not_written_down_yet_loses_nothing(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(7)
    loop.begin(7)
    loop.ticks(100, run=7)
    desk.tape.drain()  # the clerk is busy: with the run before, or with a database that is locked
    desk.kill()
    loop.trip(APP_SILENCE, 0.5, 0.5)
    loop.go(Mode.TRIPPED)
    loop.ticks(TAIL_TICKS, run=7)
    loop.ticks(LONGER_THAN_THE_RING)
    assert book.open[7].first_tick is None
    after = Desk(loop, tmp_path, book)
    after.drain()
    after.end_unseen()
    recorded, ending = book.ends[7]
    assert ending.outcome is Outcome.TRIPPED
    assert (recorded.first_tick, recorded.ticks) == (0, 100)
    assert len(recorded_ticks(tmp_path, 7)) == 100


def test_a_run_that_the_loop_never_began_has_failed(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    book.enter(7)
    loop.ticks(100)
    after = Desk(loop, tmp_path, book)
    after.drain()
    after.end_unseen()
    recorded, ending = book.ends[7]
    assert (recorded.ticks, ending.outcome) == (0, Outcome.FAILED)


def test_what_is_finished_is_not_recorded_again(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    book.enter(1)
    book.enter(2)
    Desk(loop, tmp_path, book)
    loop.whole_run(1, 100)
    desk = Desk(loop, tmp_path, book)
    desk.drain()
    # Run 2 was entered and not begun: the next app reads the whole ring again, run 1 in it.
    after = Desk(loop, tmp_path, book)
    after.drain()
    after.end_unseen()
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(10, 110))
    assert book.ended_in_order == [1, 2]
    assert book.ends[2][1].outcome is Outcome.FAILED


def test_a_lapped_ring_leaves_a_gap_that_is_counted_and_marked(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    loop.ticks(LONGER_THAN_THE_RING, run=1)
    desk.drain()
    kept = len(loop.block.ring) - 1
    assert desk.tape.current is not None
    assert desk.tape.current.missing_ticks == LONGER_THAN_THE_RING - kept
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(1)
    desk.drain()
    recorded, _ = book.ends[1]
    ticks = recorded_ticks(tmp_path, 1)
    assert len(ticks) == 100 + kept
    assert recorded.missing_ticks == LONGER_THAN_THE_RING - kept
    gaps = [event for event in book.events[1].values() if event.kind == "gap"]
    assert [(gap.tick, gap.value) for gap in gaps] == [(100, recorded.missing_ticks)]


def test_a_lapped_ring_that_swallowed_the_end_counts_up_to_the_end(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    desk.kill()
    loop.ticks(900, run=1)
    loop.trip(APP_SILENCE, 0.5, 0.5)
    loop.go(Mode.TRIPPED)
    loop.ticks(TAIL_TICKS, run=1)
    loop.ticks(LONGER_THAN_THE_RING)
    after = Desk(loop, tmp_path, book)
    after.drain()
    recorded, ending = book.ends[1]
    assert ending.outcome is Outcome.TRIPPED
    assert recorded.ticks == 100
    assert recorded.missing_ticks == pytest.approx(900 + TAIL_TICKS, abs=1)


def test_all_that_a_dead_loop_published_is_kept(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    loop.ticks(50, run=1)
    desk.finish()
    recorded, ending = book.ends[1]
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(150))
    assert (recorded.missing_ticks, ending.outcome) == (0, Outcome.INTERRUPTED)


def test_a_run_that_a_dead_loop_had_not_begun_has_failed(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    loop.ticks(10)
    desk.drain()
    book.enter(1)
    book.enter(2, life="of-the-next-loop")
    desk.finish()
    assert book.ends[1][1].outcome is Outcome.FAILED
    assert list(book.open) == [2]


def test_both_dead_and_the_block_left_over(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    book.enter(1)
    desk = Desk(loop, tmp_path, book)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    desk.kill()
    loop.ticks(50, run=1)
    after = Desk(loop, tmp_path, book)
    after.drain()
    after.finish()
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(150))
    assert book.ends[1][1].outcome is Outcome.INTERRUPTED


def test_a_detector_that_only_indicates_does_not_end_a_run(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(10, run=1)
    loop.trip(FORCE_HINT, 1200.0, 1000.0)
    loop.ticks(10, run=1)
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(1)
    desk.drain()
    assert book.ends[1][1].outcome is Outcome.COMPLETED
