"""The book of runs at the screen: found again, noted upon, reopened as it was seen, down to single ticks."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.session import HARMONIC, predict
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000
TICK_S = 250e-6


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="module")
def recorded(console: ConsoleProcess) -> int:
    """A run of the 50 Hz example that has ended."""
    predict(console, HARMONIC)
    console.make_ready()
    run_id = console.start_run(HARMONIC)
    assert console.ended_run(run_id)["outcome"] == "completed"
    return run_id


def window_s(page: Page) -> tuple[float, float]:
    """The stretch of the run that the charts show."""
    text = page.get_by_test_id("run-window").inner_text()
    low, high = re.findall(r"[\d.]+", text)
    return float(low), float(high)


def test_a_run_is_found_and_a_view_can_be_shared(
    page: Page, console: ConsoleProcess, recorded: int
) -> None:
    page.goto(f"{console.url}/#/runs")
    row = page.get_by_test_id(f"run-{recorded}")
    expect(row).to_contain_text("Completed")
    page.keyboard.press("/")
    page.keyboard.type("no such words")
    expect(page.get_by_test_id("none-found")).to_be_visible()
    page.get_by_test_id("run-search").fill("harmonic")
    expect(row).to_be_visible()
    page.get_by_test_id("filter-outcome").select_option("tripped")
    expect(row).to_have_count(0)
    page.get_by_test_id("filter-outcome").select_option("completed")
    expect(row).to_be_visible()
    assert page.url.endswith("#/runs?search=harmonic&outcome=completed")

    page.goto("about:blank")
    page.goto(f"{console.url}/#/runs?search=harmonic&outcome=completed")
    expect(page.get_by_test_id("run-search")).to_have_value("harmonic")
    expect(page.get_by_test_id("filter-outcome")).to_have_value("completed")
    expect(row).to_be_visible()


def test_tags_and_notes_are_edited_in_place_and_a_conflict_is_said(
    page: Page, console: ConsoleProcess, recorded: int
) -> None:
    page.goto(f"{console.url}/#/runs")
    page.get_by_test_id(f"edit-{recorded}").click()
    page.get_by_test_id("edit-tags").fill("pump 7, leak")
    page.get_by_test_id("save-notes").click()
    expect(page.get_by_test_id("notes-state")).to_have_text("Saved")
    run = console.run(recorded)
    assert run["tags"] == ["leak", "pump 7"]

    page.get_by_test_id("edit-notes").fill("Mine")
    other = {"operator": "Bo", "annotation": run["annotation"]}
    assert console.http.patch(f"/runs/{recorded}", json=other).is_success
    page.get_by_test_id("save-notes").click()
    expect(page.get_by_test_id("notes-state")).to_contain_text("Somebody else")
    expect(page.get_by_test_id("edit-operator")).to_have_value("Bo")
    page.get_by_test_id("save-notes").click()
    expect(page.get_by_test_id("notes-state")).to_have_text("Saved")
    run = console.run(recorded)
    assert (run["operator"], run["notes"]) == ("Bo", "Mine")


def test_a_run_zooms_to_single_ticks_and_opens_again_like_that(
    page: Page, console: ConsoleProcess, recorded: int
) -> None:
    page.goto(f"{console.url}/#/runs/{recorded}")
    chart = page.get_by_test_id("chart-run").first
    expect(page.get_by_test_id("run-note")).to_have_text("Extremes of each column")
    expect(page.get_by_test_id("run-events")).to_contain_text("Block 1")

    def turned_to_ticks() -> bool:
        chart.locator(".u-over").hover()  # what comes late moves it
        for _ in range(20):
            page.mouse.wheel(0, -200)
        page.wait_for_timeout(500)
        low, high = window_s(page)
        return high - low < 20 * TICK_S

    wait_for(turned_to_ticks, "the wheel to come down to ticks")
    expect(page.get_by_test_id("run-note")).to_have_text("Every tick")
    low, high = window_s(page)
    expect(page).to_have_url(re.compile(r"from=.*to="))

    page.goto("about:blank")
    page.goto(f"{console.url}/#/runs/{recorded}")
    expect(page.get_by_test_id("run-note")).to_have_text("Every tick")
    assert window_s(page) == (low, high)

    page.get_by_test_id("chart-run").first.get_by_role("application").focus()
    page.keyboard.press("0")
    expect(page.get_by_test_id("run-note")).to_have_text("Extremes of each column")


def test_an_event_leads_to_its_moment(page: Page, console: ConsoleProcess, recorded: int) -> None:
    events = console.http.get(f"/runs/{recorded}/events").json()["events"]
    at_s = next(event["time_s"] for event in events if event["text"] == "Block 2")
    page.goto(f"{console.url}/#/runs/{recorded}?view=settings")
    expect(page.get_by_test_id("document")).to_contain_text("kind: harmonic")
    page.get_by_test_id("run-events").get_by_role("button", name="Block 2", exact=True).click()
    expect(page.get_by_test_id("chart-run").first).to_be_visible()
    low, high = window_s(page)
    assert low <= at_s <= high <= low + 2.001


def test_measurements_stand_beside_their_criteria(
    page: Page, console: ConsoleProcess, recorded: int
) -> None:
    page.goto(f"{console.url}/#/runs/{recorded}?view=results")
    expect(page.get_by_test_id("criteria")).to_contain_text("Peak force")
    expect(page.get_by_test_id("measurements")).to_contain_text("harmonic")
