"""One console with a real loop for all tests of the interface."""

from collections.abc import Iterator

import pytest

from tests.console_process import ConsoleProcess


@pytest.fixture(scope="session")
def console(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ConsoleProcess]:
    process = ConsoleProcess(tmp_path_factory.mktemp("console"))
    try:
        yield process.start()
    finally:
        process.clean_up()


@pytest.fixture
def ready(console: ConsoleProcess) -> ConsoleProcess:
    console.make_ready()
    return console
