"""Runs beside one another at the screen: chosen in the book, laid over each other, all of it in the address."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.session import HARMONIC, predict
from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="module")
def recorded(console: ConsoleProcess) -> tuple[int, int]:
    """Two runs of the 50 Hz example that have ended."""
    predict(console, HARMONIC)
    console.make_ready()
    runs = []
    for _ in range(2):
        runs.append(console.start_run(HARMONIC))
        assert console.ended_run(runs[-1])["outcome"] == "completed"
    return runs[0], runs[1]


def test_runs_are_chosen_in_the_book_and_compared(
    page: Page, console: ConsoleProcess, recorded: tuple[int, int]
) -> None:
    first, second = recorded
    page.goto(f"{console.url}/#/runs")
    page.get_by_test_id(f"choose-{first}").check()
    expect(page.get_by_test_id("chosen")).to_contain_text("Tick one run more")
    page.get_by_test_id(f"choose-{second}").check()
    page.get_by_test_id(f"run-{second}").get_by_role("link", name=f"Open run {second}").focus()
    page.keyboard.press("m")
    expect(page).to_have_url(re.compile(rf"#/runs/compare\?ids={first},{second}$"))
    expect(page.get_by_test_id("chart-overlay")).not_to_have_attribute("data-points", "0")
    expect(page.get_by_test_id(f"difference-{second}")).to_contain_text("RMS")
    expect(page.get_by_test_id("compared-measurements")).to_contain_text("Amplitude")


def test_what_is_shown_stands_in_the_address(
    page: Page, console: ConsoleProcess, recorded: tuple[int, int]
) -> None:
    first, second = recorded
    page.goto(f"{console.url}/#/runs/compare?ids={first},{second}&abs=1&from=1&to=1.2")
    difference = page.get_by_test_id(f"difference-{second}")
    expect(difference).to_contain_text("Beyond the tolerance")
    page.get_by_test_id("tolerance-abs").fill("20")
    page.get_by_test_id("tolerance-abs").press("Enter")
    expect(difference).to_contain_text("Within the tolerance throughout")
    assert "abs=20000" in page.url
    page.get_by_test_id("compare-whole").click()
    expect(page).not_to_have_url(re.compile("from="))
    page.get_by_test_id("align-phase").click()
    expect(page).to_have_url(re.compile("align=phase"))
    expect(page.get_by_test_id("chart-overlay")).to_have_attribute("data-points", "361")
    page.get_by_test_id(f"toggle-{second}").press("Enter")
    expect(page.get_by_test_id(f"toggle-{second}")).to_have_attribute("aria-pressed", "false")
    assert f"hidden={second}" in page.url
    page.get_by_test_id(f"baseline-{second}").click()
    expect(page).to_have_url(re.compile(f"ids={second},{first}"))
    page.get_by_test_id("pane-settings").click()
    expect(page.get_by_test_id("same-settings")).to_be_visible()
    page.get_by_test_id("pane-trend").click()
    expect(page.get_by_test_id("trend-says")).to_contain_text("runs of harmonic-2-kn-50-hz")


def test_too_few_runs_are_helped_and_unknown_ones_refused(
    page: Page, console: ConsoleProcess, recorded: tuple[int, int]
) -> None:
    page.goto(f"{console.url}/#/runs/compare?ids={recorded[0]}")
    expect(page.get_by_test_id("compare-none")).to_contain_text("Tick them in the book of runs")
