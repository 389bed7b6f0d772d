"""One console with a real loop for all tests of the interface."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.console_process import OF_FOLDER, ConsoleProcess
from tests.postgres import Server


@pytest.fixture(scope="session")
def console(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[ConsoleProcess]:
    database_url = None
    if request.config.getoption("--database") == "postgresql":
        server: Server = request.getfixturevalue("postgres")
        database_url = server.url(server.new_database())
    process = ConsoleProcess(tmp_path_factory.mktemp("console"), database_url)
    try:
        OF_FOLDER[Path(__file__).parent] = process
        yield process.start()
    finally:
        process.clean_up()


@pytest.fixture
def ready(console: ConsoleProcess) -> ConsoleProcess:
    console.make_ready()
    return console
