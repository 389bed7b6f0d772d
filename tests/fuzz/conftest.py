"""A console of its own with a test under way, in command of which is somebody whom nobody here is."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.console_process import OF_FOLDER, ConsoleProcess, wait_for
from tests.fuzz.under_way import UnderWay

LONG = {
    "schema": 1,
    "name": "While everybody asks everything",
    "blocks": [{"kind": "harmonic", "amplitude_n": 1000, "frequency_hz": 5, "duration_s": 3600}],
}
BEFORE_TICKS = 8000  # which nobody has disturbed


@pytest.fixture(scope="session")
def under_way(tmp_path_factory: pytest.TempPathFactory) -> Iterator[UnderWay]:
    console = ConsoleProcess(tmp_path_factory.mktemp("fuzz"))
    try:
        OF_FOLDER[Path(__file__).parent] = console
        console.start().make_ready()
        test = console.http.post("/tests", json={"definition": LONG}).raise_for_status().json()
        run = UnderWay(console, test["id"], console.start_run(test["id"]))
        begun = run.timing().ticks
        wait_for(lambda: run.timing().ticks > begun + BEFORE_TICKS, "two seconds of the test")
        run.remember()
        yield run
    finally:
        console.clean_up()
