"""The system over HTTP, on a loop that runs."""

import pytest

from app.settings import VERSION
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]


def test_the_loop_tells_how_it_keeps_time(console: ConsoleProcess) -> None:
    before = console.http.get("/system/loop").json()
    assert (before["alive"], before["period_s"]) == (True, 250e-6)

    def later() -> bool:
        now = console.http.get("/system/loop").json()
        since = sum(now["wakeup"]["counts"]) - sum(before["wakeup"]["counts"])
        return bool(now["life"] == before["life"] and since == now["ticks"] - before["ticks"] > 0)

    wait_for(later, "more ticks")


def test_the_doctor_looks_without_a_probe(console: ConsoleProcess) -> None:
    found = console.http.get("/system/doctor").json()
    assert {"preemption", "wakeups_of_the_loop"} <= {item["name"] for item in found["findings"]}
    assert "No probe" in found["measured"]


def test_what_runs_here_is_told(console: ConsoleProcess) -> None:
    found = console.http.get("/system/about").json()
    assert found["version"] == VERSION
    assert found["database"] == console.database_url.partition(":")[0]
    assert found["data_bytes"] > 0
    assert found["uptime_s"] > 0
    assert found["loop_memory_bytes"] > found["clients"] >= 0
