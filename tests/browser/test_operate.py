"""An operator at the screen: the 50 Hz example from reset to its recording."""

import re
import signal

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.session import HARMONIC, choose, is_at, make_ready, predict, take_command
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 100_000


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


def samples(chart: Locator) -> int:
    """How many samples a live chart has been given."""
    return int(chart.get_attribute("data-samples") or 0)


def test_the_50_hz_example_runs_to_its_end(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    choose(page, HARMONIC)
    expect(page.get_by_test_id("prediction-verdict")).to_have_text("Clear")
    expect(page.get_by_test_id("margins")).to_contain_text("Supply pressure")
    page.get_by_test_id("entry-operator").fill("Ada")
    page.get_by_test_id("entry-tags").fill("pump 7, first")
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
    assert (run["operator"], run["tags"]) == ("Ada", ["first", "pump 7"])
    assert run["prediction_verdict"] == "clear"
    assert samples(chart) >= run["ticks"]

    panel = page.get_by_test_id("outcome-panel")
    expect(panel.get_by_test_id("run-outcome")).to_have_text("Completed")
    expect(panel.get_by_test_id("criteria")).to_contain_text("Peak force")
    page.get_by_test_id("open-ended-run").click()
    expect(page.get_by_test_id("chart-run").first).to_be_visible()
    expect(page.get_by_test_id("run-outcome")).to_have_text(re.compile("completed", re.IGNORECASE))


def test_a_hold_shows_what_resume_will_do(page: Page, console: ConsoleProcess) -> None:
    layer = {"mean_n": 0, "amplitude_n": 1000, "frequency_hz": 10, "cycles": 10}
    definition = {
        "schema": 1,
        "name": "Long enough to hold",
        "blocks": [{"kind": "layers", "layers": [layer], "repeats": 200, "transition_s": 0.2}],
    }
    made = console.http.post("/tests", json={"definition": definition})
    assert made.status_code == 201, made.text
    test_id = made.json()["id"]
    predict(console, test_id)
    make_ready(page, console)
    console.take_command()
    start = {"test_id": test_id, "override_reason": "It is to be held"}
    assert console.http.post("/runs", json=start).status_code == 201
    is_at(page, "running")
    take_command(page)
    page.get_by_test_id("cmd-hold").click()
    is_at(page, "holding")
    preview = page.get_by_test_id("resume-preview")
    expect(preview.get_by_test_id("resume-words")).not_to_be_empty()
    expect(preview.locator("canvas")).to_have_count(2)
    page.get_by_test_id("cmd-resume").click()
    is_at(page, "running")
    expect(preview).to_have_count(0)
    page.get_by_test_id("stop").click()
    is_at(page, "ready")


def test_a_caution_wants_a_reason_and_keeps_it(page: Page, console: ConsoleProcess) -> None:
    definition = {
        "schema": 1,
        "name": "Cannot pass",
        "blocks": [
            {"kind": "ramp", "to_n": 1000, "rate_n_s": 1000},
            {"kind": "ramp", "to_n": 0, "rate_n_s": 1000},
        ],
        "acceptance": [{"measurement": "peak_force_n", "at_most": 500}],
    }
    made = console.http.post("/tests", json={"definition": definition})
    assert made.status_code == 201, made.text
    make_ready(page, console)
    choose(page, made.json()["id"])
    expect(page.get_by_test_id("prediction-verdict")).to_have_text("Caution")
    page.get_by_test_id("cmd-start").click()
    field = page.get_by_test_id("override-reason")
    expect(field).to_be_focused()
    field.press("Enter")
    is_at(page, "ready")
    field.fill("The force itself is wanted")
    field.press("Enter")
    is_at(page, "running")
    is_at(page, "ready")
    run = console.ended_run(console.http.get("/runs").json()["runs"][0]["id"])
    assert run["override_reason"] == "The force itself is wanted"
    assert (run["prediction_verdict"], run["verdict"]) == ("caution", "fail")


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
    choose(page, HARMONIC)
    page.get_by_test_id("cmd-start").click()
    is_at(page, "running")
    page.get_by_test_id("stop").click()
    is_at(page, "ready")
    run = console.ended_run(console.http.get("/runs").json()["runs"][0]["id"])
    assert (run["outcome"], run["reason"]) == ("stopped", "Stopped by the operator")
