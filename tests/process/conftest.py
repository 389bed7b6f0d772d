"""A console on a data directory of its own, cleaned up whatever the test did to it."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.console_process import ConsoleProcess


@pytest.fixture
def console(tmp_path: Path) -> Iterator[ConsoleProcess]:
    process = ConsoleProcess(tmp_path)
    try:
        yield process
    finally:
        process.clean_up()
