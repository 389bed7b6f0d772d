"""The whole console on PostgreSQL: a run from start to book, kill -9 included."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.console_process import ConsoleProcess
from tests.postgres import Server

pytestmark = [pytest.mark.process, pytest.mark.slow]


@pytest.fixture
def url(postgres: Server) -> str:
    return postgres.url(postgres.new_database())


@pytest.fixture
def console(tmp_path: Path, url: str) -> Iterator[ConsoleProcess]:
    process = ConsoleProcess(tmp_path, url)
    try:
        yield process.start()
    finally:
        process.clean_up()


def test_runs_are_kept_in_the_server(console: ConsoleProcess) -> None:
    assert not list(console.data.glob("*.sqlite*"))
    console.make_ready()
    first = console.start_run("step-2-kn")
    assert console.ended_run(first)["outcome"] == "completed"
    second = console.start_run("hold-50-kn")
    console.kill()
    console.start()
    console.command("stop")
    # The loop trips where the console is away for too long.
    assert console.ended_run(second)["outcome"] in ("stopped", "tripped")
    book = console.http.get("/runs?search=step%202&outcome=completed").json()["runs"]
    assert [run["id"] for run in book] == [first]


def test_a_second_console_is_refused_the_database(
    console: ConsoleProcess, url: str, tmp_path: Path
) -> None:
    folder = tmp_path / "other"
    folder.mkdir()
    other = ConsoleProcess(folder, url)
    with pytest.raises(AssertionError, match="another console uses the database"):
        other.start()
