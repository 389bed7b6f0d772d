"""What an operator does again and again, for the tests that look at the console."""

import re

from playwright.sync_api import Page, expect

from tests.console_process import ConsoleProcess, wait_for

HARMONIC = "harmonic-2-kn-50-hz"


def is_at(page: Page, mode: str) -> None:
    """The mode on the screen matches."""
    expect(page.get_by_test_id("mode")).to_have_text(re.compile(mode, re.IGNORECASE))


def choose(page: Page, test_id: str) -> None:
    """Choose a test, and wait for its prediction: Start waits for it, too."""
    page.get_by_test_id(f"test-{test_id}").click()
    expect(page.get_by_test_id("prediction-verdict")).to_be_visible()


def take_command(page: Page) -> None:
    """Be in command on this page, over whoever is."""
    page.get_by_test_id("in-command").click()
    expect(page.get_by_test_id("take").or_(page.get_by_test_id("take-over"))).to_be_visible()
    if page.get_by_test_id("take").is_visible():
        page.get_by_test_id("take").click()
    else:
        page.get_by_test_id("ask-reason").fill("The tests")
        page.get_by_test_id("take-over").click()
    expect(page.get_by_test_id("holder")).to_have_text("You")


def make_ready(page: Page, console: ConsoleProcess) -> None:
    """Take command, reset and pressurise by the buttons, from a latched rig."""
    assert console.command("shutdown").is_success
    page.goto(console.url)
    is_at(page, "tripped")
    take_command(page)
    page.get_by_test_id("cmd-reset").click()
    is_at(page, "off")
    page.get_by_test_id("cmd-pressurise").click()
    is_at(page, "ready")


def predict(console: ConsoleProcess, test_id: str) -> None:
    """Have a test predicted: a start waits for that, but not for ever."""

    def known() -> bool:
        answer = console.http.post(f"/tests/{test_id}/prediction", json={"wait_s": 10})
        return "verdict" in answer.json()

    wait_for(known, f"the prediction of {test_id}")
