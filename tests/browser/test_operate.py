"""An operator at the screen: the 50 Hz example from reset to its recording."""

import re
import signal

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000
HARMONIC = "harmonic-2-kn-50-hz"


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


def samples(chart: Locator) -> int:
    """How many samples a live chart has been given."""
    return int(chart.get_attribute("data-samples") or 0)


def is_at(page: Page, mode: str) -> None:
    expect(page.get_by_test_id("mode")).to_have_text(re.compile(mode, re.IGNORECASE))


def make_ready(page: Page, console: ConsoleProcess) -> None:
    """Reset and pressurise by the buttons, from a latched rig."""
    assert console.command("shutdown").is_success
    page.goto(console.url)
    is_at(page, "tripped")
    page.get_by_test_id("cmd-reset").click()
    is_at(page, "off")
    page.get_by_test_id("cmd-pressurise").click()
    is_at(page, "ready")


def test_the_50_hz_example_runs_to_its_end(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    page.get_by_test_id(f"test-{HARMONIC}").click()
    page.get_by_test_id("cmd-start").click()
    is_at(page, "running")
    expect(page.get_by_test_id("stale-banner")).to_have_count(0)
    chart = page.get_by_test_id("chart-force")
    first = wait_for(lambda: samples(chart), "the first samples")
    wait_for(lambda: samples(chart) > first + 4000, "the chart to move")
    is_at(page, "ready")

    run_id = console.http.get("/runs").json()["runs"][0]["id"]
    run = console.ended_run(run_id)
    assert (run["outcome"], run["missing_ticks"]) == ("completed", 0)
    assert samples(chart) >= run["ticks"]

    page.goto(f"{console.url}/#/runs")
    row = page.get_by_test_id(f"run-{run_id}")
    expect(row).to_contain_text(re.compile("completed", re.IGNORECASE))
    row.get_by_role("link", name=f"Open run {run_id}").click()
    expect(page.get_by_test_id("chart-run").first).to_be_visible()
    expect(page.get_by_test_id("run-outcome")).to_have_text(re.compile("completed", re.IGNORECASE))


def test_a_screen_whose_console_froze_says_so(page: Page, console: ConsoleProcess) -> None:
    page.goto(console.url)
    is_at(page, "tripped|off|ready")
    expect(page.get_by_test_id("stale-banner")).to_have_count(0)
    console.signal(signal.SIGSTOP)
    try:
        expect(page.get_by_test_id("stale-banner")).to_be_visible()
    finally:
        console.signal(signal.SIGCONT)
    expect(page.get_by_test_id("stale-banner")).to_have_count(0)


def test_stop_is_one_press(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    page.get_by_test_id(f"test-{HARMONIC}").click()
    page.get_by_test_id("cmd-start").click()
    is_at(page, "running")
    page.get_by_test_id("stop").click()
    is_at(page, "ready")
    run = console.ended_run(console.http.get("/runs").json()["runs"][0]["id"])
    assert (run["outcome"], run["reason"]) == ("stopped", "Stopped by the operator")
