"""A frequency response as an engineer sees it: live on Operate, afterwards on the run's page, and taken away."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.session import is_at, make_ready
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
DEFINITION = {
    "schema": 1,
    "name": "A short response",
    "blocks": [
        {
            "kind": "frequency_response",
            "amplitudes_n": [1000, 2000],
            "frequencies_hz": [20, 40, 60, 80, 100],
            "settle_cycles": 5,
            "measure_cycles": 20,
            "bands": [{"from_hz": 20, "to_hz": 60, "low_db": -3, "high_db": 4}],
        }
    ],
}


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=100_000)


def test_a_response_is_seen_live_read_off_and_taken_away(
    page: Page, console: ConsoleProcess
) -> None:
    made = console.http.post("/tests", json={"definition": DEFINITION, "author": "ada"})
    assert made.status_code == 201, made.text
    make_ready(page, console)
    run_id = console.start_run(made.json()["id"])

    panel = page.get_by_test_id("response-panel")
    chart = panel.get_by_test_id("chart-bode")
    wait_for(lambda: int(chart.get_attribute("data-points") or 0) >= 2, "the first points")
    is_at(page, "running")
    expect(panel.get_by_test_id("response-points")).to_contain_text("of 10 points")
    page.keyboard.press("v")
    expect(panel).to_have_count(0)
    page.keyboard.press("v")
    expect(chart).to_be_visible()
    assert console.ended_run(run_id)["outcome"] == "completed"

    page.goto(f"{console.url}/#/runs/{run_id}?view=response")
    bode = page.get_by_test_id("run-bode")
    expect(bode.get_by_test_id("chart-bode")).to_have_attribute("data-points", "5")
    expect(bode.get_by_test_id("bode-extremes")).to_contain_text(
        re.compile(r"2\skN: \+\d\.\d\sdB at")
    )
    expect(bode.get_by_test_id("bode-table")).to_contain_text("1 kN")
    bode.get_by_role("application").focus()
    page.keyboard.press("End")
    expect(bode.get_by_test_id("bode-cursor")).to_have_text("100 Hz")
    page.keyboard.press("ArrowLeft")
    expect(bode.get_by_test_id("bode-cursor")).to_have_text("80 Hz")
    bode.get_by_test_id("transfer-plant").click()
    expect(bode).to_contain_text("kN")

    page.get_by_test_id("view-analysis").click()
    expect(page.get_by_test_id("analysis-facts")).to_contain_text("at the unit")

    page.get_by_test_id("view-files").click()
    page.get_by_test_id("format-csv").click()
    page.get_by_test_id("export").click()
    with page.expect_download() as download:
        page.get_by_test_id("export-file").click()
    text = download.value.path().read_text()
    assert "force_n [N]" in text
    assert text.count("\n") > console.run(run_id)["ticks"]
