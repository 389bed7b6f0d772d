"""An engineer at the controller: a value tried, analysed as it is typed, put in force, and taken back."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser.session import take_command
from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000
SHIPPED_K_P = 1.19e-5


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


def in_force(console: ConsoleProcess) -> dict[str, Any]:
    found: dict[str, Any] = console.http.get("/controller").json()
    return found


@pytest.fixture
def in_command(page: Page, console: ConsoleProcess) -> Iterator[Page]:
    """The page of the controller, of somebody who is in command; what it changes is put back."""
    before = in_force(console)
    page.goto(f"{console.url}/#/controller")
    expect(page.get_by_test_id("margins-2000")).to_be_visible()
    take_command(page)
    yield page
    now = in_force(console)
    if now["document"] != before["document"]:
        console.take_command()
        body = {"why": "As before the test", "based_on": now["revision"]}
        path = f"/controller/revisions/{before['revision']}/restore"
        assert console.http.post(path, json=body).is_success
        console.http.delete("/lease")


def value(page: Page, path: str) -> Any:
    return page.get_by_test_id(f"value-{path}")


def test_a_change_is_analysed_tried_put_in_force_and_taken_back(
    in_command: Page, console: ConsoleProcess
) -> None:
    page, before = in_command, in_force(console)
    value(page, "k_p").fill("9e-6")
    expect(page.get_by_test_id("controller-changes")).to_contain_text("K_P 0.000009 1/N")
    expect(page.get_by_test_id("margins-2000")).to_contain_text("45.7")  # struck through: in force
    page.get_by_test_id("controller-try").click()
    page.get_by_test_id("try").click()
    expect(page.get_by_test_id("tried-outcome")).to_contain_text("completed")
    assert in_force(console)["document"]["k_p"] == before["document"]["k_p"]
    expect(page.get_by_test_id("apply-reason")).to_have_text("Say why")
    page.get_by_test_id("why").fill("Softer unit")
    page.get_by_test_id("apply-controller").click()
    made = before["revision"] + 1
    expect(page.get_by_test_id("controller-revision")).to_have_text(f"Revision {made}")
    assert (in_force(console)["document"]["k_p"], in_force(console)["in_loop"]) == (9e-6, True)
    page.get_by_test_id("controller-history").click()
    expect(page.get_by_test_id("controller-difference")).to_contain_text("K_P")
    page.get_by_test_id(f"go-back-{before['revision']}").click()
    expect(page.get_by_test_id("controller-revision")).to_have_text(f"Revision {made + 1}")
    assert in_force(console)["document"] == before["document"]


def test_drafts_are_undone_step_by_step_and_survive_a_reload(in_command: Page) -> None:
    page = in_command
    page.get_by_test_id("preset-COMP8").click()
    expect(value(page, "compensator.ff_v")).to_have_value("4.2148")
    value(page, "k_i").fill("0.005")
    page.get_by_test_id(
        "controller-loop"
    ).click()  # away from the field, whose own undo comes first
    page.keyboard.press("Control+z")
    expect(value(page, "k_i")).to_have_value("0.00438")
    page.keyboard.press("Control+z")
    expect(value(page, "compensator.ff_v")).to_have_value("1.9607")
    page.keyboard.press("Control+Shift+z")
    expect(value(page, "compensator.ff_v")).to_have_value("4.2148")
    page.reload()
    expect(value(page, "compensator.ff_v")).to_have_value("4.2148")
    page.get_by_test_id("discard-controller").click()
    expect(value(page, "compensator.ff_v")).to_have_value("1.9607")


def test_the_branch_is_tuned_exactly_and_what_is_wrong_is_said_at_its_field(
    in_command: Page,
) -> None:
    page = in_command
    page.get_by_test_id("tune-hz").fill("6")
    expect(page.get_by_test_id("exact")).to_contain_text("s/m")
    before = page.get_by_test_id("branch-margins").inner_text()
    page.get_by_test_id("tune").click()
    expect(value(page, "compensator.ff_v")).not_to_have_value("1.9607")
    expect(page.get_by_test_id("branch-margins")).not_to_have_text(before)
    value(page, "compensator.low_pass_hz").fill("2500")
    expect(page.get_by_role("alert").filter(has_text=re.compile("below"))).to_be_visible()
    expect(page.get_by_test_id("apply-reason")).to_have_text("1 value is wrong")
    page.get_by_test_id("discard-controller").click()
