"""An engineer who gives the simulated rig a fault, and looks at how it stood up to it."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.session import make_ready
from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


def open_drills(page: Page) -> None:
    page.get_by_test_id("nav-drills").click()
    expect(page.get_by_test_id("drills").get_by_role("button")).to_have_count(16)


def test_a_drill_is_announced_given_and_scored(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    open_drills(page)
    page.get_by_test_id("drill-load_cell_frozen").click()
    page.get_by_test_id("inject").click()
    expect(page.get_by_test_id("announcement")).to_contain_text("The rig must trip: Load cell")
    page.get_by_test_id("cancel-inject").click()
    assert console.http.get("/drills").json()["under_way"] is None
    page.get_by_test_id("inject").click()
    expect(page.get_by_test_id("confirm-inject")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("drill-state")).to_have_text("Passed")
    told = page.get_by_test_id("expectations")
    expect(told).to_contain_text("load_cell was the first-out")
    expect(told.locator(".unmet")).to_have_count(0)
    record = page.get_by_test_id("drill-record")
    expect(record).to_contain_text(re.compile(r"Knew after\s*\d+ ticks, \d+"))
    expect(page.get_by_test_id("drill-chart").locator("canvas")).to_have_count(3)
    page.get_by_test_id("drills-history").click()
    expect(page.get_by_test_id("tally")).to_contain_text("passed")
    row = page.get_by_test_id("drill-history").locator("tbody tr").first
    expect(row).to_contain_text(re.compile(r"Load cell frozen.*Passed", re.DOTALL))
    expect(page.get_by_test_id("drill-strip")).to_have_count(0)


def test_what_cannot_be_given_says_why(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    open_drills(page)
    page.get_by_test_id("drill-valve_stuck").click()
    expect(page.get_by_test_id("inject")).to_have_attribute("aria-disabled", "true")
    expect(page.get_by_test_id("inject-refusal")).to_contain_text("start a test first")
    page.get_by_test_id("drill-late_ticks").click()
    amount = page.locator('[data-path="amount"]')
    expect(amount).to_have_value("20")
    amount.fill("80")
    expect(page.get_by_test_id("inject-refusal")).to_contain_text(re.compile(r"0.1\sms … 50\sms"))
    amount.fill("15")
    expect(page.get_by_test_id("inject")).to_have_attribute("aria-disabled", "false")
    assert console.command("shutdown").is_success
    expect(page.get_by_test_id("inject-refusal")).to_contain_text("needs a rig that is ready")


def test_a_fault_under_way_is_taken_back(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    open_drills(page)
    page.get_by_test_id("drill-load_cell_drift").click()
    page.locator('[data-path="amount"]').fill("0,01")
    page.get_by_test_id("inject").click()
    page.get_by_test_id("confirm-inject").click()
    expect(page.get_by_test_id("drill-watched")).to_contain_text("Watching")
    page.get_by_test_id("clear-faults").click()
    expect(page.get_by_test_id("drill-state")).to_have_text("Interrupted")
    assert console.http.get("/drills").json()["injected"] == {}
