"""Long work apart: done, failed, died, given up."""

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from app.errors import Code, Refusal
from app.jobs.apart import NICENESS, GivenUp, WorkFailed, run_apart
from app.jobs.jobs import Job, Jobs, JobState
from app.jobs.stream import PIECE_BYTES, Stream
from tests.console_process import wait_for
from tests.unit.app.jobs import work

pytestmark = pytest.mark.process


@pytest.fixture
def jobs() -> Iterator[Jobs[Any]]:
    found: Jobs[Any] = Jobs("test")
    yield found
    found.close()


def started(found: Job[Any] | Refusal) -> Job[Any]:
    assert isinstance(found, Job)
    return found


def test_work_is_done_elsewhere_and_reported() -> None:
    shares: list[float] = []
    assert run_apart(work.squares, 4, report=shares.append) == [0, 1, 4, 9]
    assert shares == [0.25, 0.5, 0.75, 1.0]


def test_it_gives_way_to_everything_else() -> None:
    assert run_apart(work.priority, report=lambda _: None) == NICENESS


def test_what_it_raises_is_told() -> None:
    with pytest.raises(WorkFailed, match="ValueError: no such orifice"):
        run_apart(work.wrong, report=lambda _: None)


def test_a_process_that_dies_is_told() -> None:
    with pytest.raises(WorkFailed, match="ended before it was done"):
        run_apart(work.dies, report=lambda _: None)


def test_what_nobody_wants_leaves_no_process(tmp_path: Path) -> None:
    began, unwanted = tmp_path / "began", threading.Event()

    def give_up_once_it_runs() -> None:
        wait_for(lambda: began.exists() and began.read_text(), "the work")
        unwanted.set()

    watcher = threading.Thread(target=give_up_once_it_runs)
    watcher.start()
    with pytest.raises(GivenUp):
        run_apart(work.endless, began, report=lambda _: None, unwanted=unwanted)
    watcher.join()
    with pytest.raises(ProcessLookupError):
        os.kill(int(began.read_text()), 0)


def test_a_stream_outlives_the_thread_that_began_it() -> None:
    with ThreadPoolExecutor(1) as threads:
        stream = threads.submit(Stream, work.trickle, 10).result()
        pieces = iter(stream)
        first = next(pieces)
    assert len(first) + sum(map(len, pieces)) == 10 * PIECE_BYTES
    stream.close()


def test_work_ends_with_the_process_that_wanted_it(tmp_path: Path) -> None:
    began = tmp_path / "began"
    program = f"from tests.unit.app.jobs import work; work.await_ending(__import__('pathlib').Path({str(began)!r}))"
    wants = subprocess.Popen([sys.executable, "-c", program])
    wait_for(lambda: began.exists() and began.read_text(), "the work")
    wants.kill()
    wants.wait()
    wait_for(lambda: not lives(began.read_text()), "the end of the work")


def lives(pid: str) -> bool:
    """Whether a process has not ended; one that nobody has waited for yet has no command line left."""
    try:
        return bool(Path(f"/proc/{pid}/cmdline").read_bytes())
    except OSError:
        return False


def test_a_job_is_known_until_it_has_ended_and_after(jobs: Jobs[Any]) -> None:
    job = started(jobs.start("Squares", work.squares, 3, then=lambda found: found[::-1]))
    assert job.ended.wait(60)
    assert (job.state, job.share, job.result) == (JobState.DONE, 1.0, [4, 1, 0])
    assert jobs.get(job.id) is job
    assert isinstance(jobs.get("nothing"), Refusal)


def test_a_job_that_fails_says_why(jobs: Jobs[Any]) -> None:
    job = started(jobs.start("Wrong", work.wrong))
    assert job.ended.wait(60)
    assert job.state is JobState.FAILED
    assert job.reason == "ValueError: no such orifice"


def test_a_job_whose_process_died_is_nobodys_fault(jobs: Jobs[Any]) -> None:
    died, wrong = (started(jobs.start(title, getattr(work, title))) for title in ("dies", "wrong"))
    assert died.ended.wait(60)
    assert wrong.ended.wait(60)
    told = died.why_not("Nothing was made", Code.NO_DATA)
    assert (told.code, told.detail[-9:]) == (Code.BROKE_OFF, "try again")
    assert wrong.why_not("Nothing was made", Code.NO_DATA).code is Code.NO_DATA


def test_jobs_are_given_up_running_or_waiting(jobs: Jobs[Any], tmp_path: Path) -> None:
    first = started(jobs.start("Endless", work.endless, tmp_path / "began"))
    second = started(jobs.start("Squares", work.squares, 3))
    assert second.state is JobState.WAITING
    jobs.cancel(second.id)
    jobs.cancel(first.id)
    assert first.ended.wait(60)
    assert second.ended.wait(60)
    assert (first.state, second.state) == (JobState.CANCELLED, JobState.CANCELLED)
    assert second.result is None
