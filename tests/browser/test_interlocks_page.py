"""An engineer at the interlocks: detectors as they are, a table changed, a trip with its black box."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.session import is_at, make_ready, take_command
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture
def in_command(page: Page, console: ConsoleProcess) -> Iterator[Page]:
    """The page of the interlocks, of somebody who is in command; what it changes is put back."""
    before = table(console)
    page.goto(f"{console.url}/#/interlocks")
    expect(page.get_by_test_id("detectors")).to_have_attribute("data-stale", "false")
    take_command(page)
    yield page
    put(console, before, "As before the test")


def table(console: ConsoleProcess) -> dict[str, Any]:
    """The interlocks in force."""
    found: dict[str, Any] = console.http.get("/interlocks").json()
    return found


def put(console: ConsoleProcess, wanted: dict[str, Any], why: str) -> None:
    """Put a table in force on top of what is, from another client."""
    now = table(console)
    if now["detectors"] == wanted["detectors"]:
        return
    console.take_command()
    keys = ("detectors", "knowingly_weaker")
    body = {key: wanted[key] for key in keys} | {"why": why, "based_on": now["revision"]}
    answer = console.http.put("/interlocks", json=body)
    assert answer.is_success, answer.text
    console.http.delete("/lease")


def with_limit(wanted: dict[str, Any], name: str, threshold: float) -> dict[str, Any]:
    """The same table with another limit of one detector."""
    changed = [
        detector | {"threshold": threshold} if detector["name"] == name else detector
        for detector in wanted["detectors"]
    ]
    return wanted | {"detectors": changed}


def limit_of(console: ConsoleProcess, name: str) -> float:
    """The limit of a detector in force."""
    return float(next(d["threshold"] for d in table(console)["detectors"] if d["name"] == name))


def field(page: Page, name: str, key: str) -> Locator:
    """A field of the draft of a detector."""
    return page.get_by_test_id(f"draft-{name}").locator(f'[data-path$=".{key}"]')


def edit(page: Page) -> None:
    page.get_by_test_id("edit-interlocks").click()
    expect(page.get_by_test_id("draft")).to_be_visible()


def save(page: Page, why: str) -> None:
    page.get_by_test_id("why").fill(why)
    page.get_by_test_id("save-interlocks").click()
    expect(page.get_by_test_id("detectors")).to_be_visible()


def test_every_detector_shows_what_it_sees_now(page: Page, console: ConsoleProcess) -> None:
    make_ready(page, console)
    page.keyboard.press("4")
    expect(page.get_by_test_id("detectors")).to_have_attribute("data-stale", "false")
    for name in ("force", "load_cell", "supply_pressure"):
        expect(page.get_by_test_id(f"detector-{name}")).to_have_attribute("data-state", "content")
    pressure = page.get_by_test_id("detector-supply_pressure")
    expect(pressure).to_contain_text(re.compile(r"20\d\.\d\sbar|21\d\.\d\sbar"))
    expect(page.get_by_test_id("detector-load_cell")).to_contain_text("sound")
    force = page.get_by_test_id("detector-force").locator(".value")
    before = force.inner_text()
    wait_for(lambda: force.inner_text() != before, "a force that moves")
    assert console.command("depressurise").is_success
    expect(page.get_by_test_id("detector-force")).to_have_attribute("data-state", "not_armed")
    page.get_by_test_id("order").select_option("margin")
    last = page.locator("[data-testid=detectors] tbody tr").last
    expect(last).to_have_attribute("data-state", re.compile("not_armed|off"))


def test_a_limit_is_changed_refused_mended_and_put_in_force(
    in_command: Page, console: ConsoleProcess
) -> None:
    page, before = in_command, table(console)["revision"]
    edit(page)
    threshold = field(page, "displacement", "threshold")
    threshold.fill("40")
    expect(page.get_by_test_id("said").first).to_contain_text("would never be passed")
    expect(threshold).to_have_attribute("aria-invalid", "true")
    expect(page.get_by_test_id("save-interlocks")).to_have_attribute("aria-disabled", "true")
    threshold.fill("30,5")
    expect(page.get_by_test_id("said")).to_have_count(0)
    changes = page.get_by_test_id("changes")
    expect(changes).to_contain_text(
        re.compile(r"Displacement.*limit.*32.000\smm.*30.500\smm", re.DOTALL)
    )
    expect(page.get_by_test_id("save-reason")).to_have_text("Say why")
    save(page, "A shorter unit under test")
    expect(page.get_by_test_id("interlocks-revision")).to_have_text(f"Revision {before + 1}")
    expect(page.get_by_test_id("detector-displacement")).to_contain_text(re.compile(r"30.50\smm"))
    assert limit_of(console, "displacement") == pytest.approx(0.0305)
    page.get_by_test_id("interlocks-history").click()
    row = page.get_by_test_id(f"interlocks-revision-{before + 1}")
    expect(row).to_contain_text("A shorter unit under test")
    expect(page.get_by_test_id("interlocks-difference")).to_contain_text("30.500")
    page.get_by_test_id(f"restore-{before}").click()
    expect(field(page, "displacement", "threshold")).to_have_value("32")
    expect(page.get_by_test_id("changes")).to_contain_text(re.compile(r"32.000\smm"))
    page.get_by_test_id("discard-interlocks").click()


def test_what_was_done_to_a_draft_is_undone_and_redone(
    in_command: Page, console: ConsoleProcess
) -> None:
    page = in_command
    edit(page)
    count = len(table(console)["detectors"])
    rows = page.locator("[data-draft]")
    page.get_by_test_id("duplicate-force").click()
    expect(rows).to_have_count(count + 1)
    page.get_by_test_id("remove-velocity").click()
    page.get_by_test_id("add-detector").click()
    expect(rows).to_have_count(count + 1)
    expect(page.get_by_test_id("changes")).to_contain_text("removed")
    for _ in range(3):
        page.keyboard.press("Control+z")
    expect(rows).to_have_count(count)
    expect(page.get_by_test_id("save-reason")).to_have_text("Nothing has changed")
    page.keyboard.press("Control+Shift+z")
    expect(page.get_by_test_id("draft-force_2")).to_be_visible()
    page.reload()
    expect(page.get_by_test_id("found-draft")).to_be_visible()
    expect(page.get_by_test_id("draft-force_2")).to_be_visible()
    page.get_by_test_id("discard-interlocks").click()
    assert len(table(console)["detectors"]) == count


def test_another_table_in_between_is_shown_and_nothing_typed_is_lost(
    in_command: Page, console: ConsoleProcess
) -> None:
    page, before = in_command, table(console)
    edit(page)
    field(page, "velocity", "threshold").fill("350")
    put(console, with_limit(before, "displacement", 0.031), "Meanwhile")
    conflict = page.get_by_test_id("interlocks-conflict")
    expect(conflict).to_contain_text("Meanwhile")
    expect(conflict).to_contain_text(re.compile(r"31.000\smm"))
    expect(conflict).to_contain_text(re.compile(r"350.00\smm/s"))
    expect(field(page, "velocity", "threshold")).to_have_value("350")
    take_command(page)
    page.get_by_test_id("why").fill("Mine, knowing theirs")
    page.get_by_test_id("conflict-save").click()
    expect(page.get_by_test_id("detectors")).to_be_visible()
    assert limit_of(console, "velocity") == pytest.approx(0.35)
    assert table(console)["revision"] == before["revision"] + 2


def test_a_weaker_protection_has_to_be_meant(in_command: Page, console: ConsoleProcess) -> None:
    page = in_command
    edit(page)
    field(page, "force", "threshold").fill("58")
    expect(page.get_by_test_id("weakened")).to_contain_text("Force")
    page.get_by_test_id("why").fill("A stiffer joint")
    expect(page.get_by_test_id("save-interlocks")).to_have_attribute("aria-disabled", "true")
    page.get_by_test_id("accept-force").check()
    page.get_by_test_id("save-interlocks").click()
    expect(page.get_by_test_id("detectors")).to_be_visible()
    assert "force" in table(console)["knowingly_weaker"]


def test_a_trip_has_its_black_box_down_to_ticks_and_is_played_again(
    page: Page, console: ConsoleProcess
) -> None:
    make_ready(page, console)
    page.keyboard.press("7")
    page.get_by_test_id("drill-load_cell_open").click()
    page.get_by_test_id("inject").click()
    page.get_by_test_id("confirm-inject").click()
    is_at(page, "tripped")
    page.keyboard.press("4")
    panel = page.get_by_test_id("first-out")
    expect(panel.get_by_test_id("first-out-text")).to_contain_text("Load cell")
    page.get_by_test_id("acknowledge-first-out").click()
    expect(panel).to_contain_text("Acknowledged")
    page.get_by_test_id("black-box").click()
    expect(page.get_by_test_id("box-drill")).to_contain_text("load cell open")
    expect(page.get_by_test_id("trips-kept").locator("li").first).to_contain_text("Load cell")
    page.get_by_test_id("single-ticks").click()
    expect(page.get_by_test_id("run-note")).to_have_text("Every tick")
    expect(page.get_by_test_id("run-window")).to_have_text(re.compile(r"−0\.00250 … 0\.00250"))
    page.get_by_test_id("cause").fill("A drill")
    page.get_by_test_id("save-note").click()
    page.get_by_test_id("box-replay").click()
    expect(page.get_by_test_id("replay-text")).to_contain_text("exactly as the loop did")
    page.get_by_test_id("replay-detector").select_option("force")
    page.locator('[data-path="replay"]').fill("59,9")
    expect(page.get_by_test_id("replay-text")).to_contain_text("instead of")
    page.get_by_test_id("box-rerun").click()
    page.get_by_test_id("rerun-search").fill("force threshold")
    page.get_by_test_id("rerun-paths").get_by_role("option").first.click()
    page.locator('[data-path="rerun"]').fill("59,9")
    page.get_by_test_id("start-rerun").click()
    expect(page.get_by_test_id("rerun-text")).to_contain_text("virtual rig")
    expect(page.get_by_test_id("chart-run").first).to_contain_text("Virtual, changed")
    page.goto(f"{console.url}/#/interlocks")
    page.get_by_test_id("interlocks-first-outs").click()
    expect(page.get_by_test_id("first-outs").locator("tbody tr").first).to_contain_text("A drill")
