"""A test engineer at the screen: a test from its first line to its revisions."""

import re
from typing import Any

import pytest
import yaml
from playwright.sync_api import Page, expect

from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 60_000
SPECTRUM = (
    "Cycles\tMean [kN]\tAmplitude [kN]\tFrequency [Hz]\n50\t0\t2\t10\n100\t1,5\t3\t20\n20\t-2\t4\t5"
)
COMMENTED = """\
schema: 1
name: With a comment
blocks:
  - {kind: hold, duration_s: 1} # where it is
"""
WITHOUT_FIELD = (".kind", ".until")  # the one is the block itself, the other has one value only
PASTE = """(text) => {
    const data = new DataTransfer();
    data.setData("text/plain", text);
    const event = { clipboardData: data, bubbles: true, cancelable: true };
    document.activeElement.dispatchEvent(new ClipboardEvent("paste", event));
}"""


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


def key(page: Page, path: str) -> Any:
    """The field of the form for a key."""
    return page.locator(f'[data-path="{path}"]')


def row(page: Page, path: str) -> Any:
    """The row of the outline for a block."""
    return page.locator(f'[data-row="{path}"]')


def begin(page: Page, console: ConsoleProcess, name: str) -> None:
    page.goto(f"{console.url}/#/new-test")
    page.get_by_test_id("test-name").fill(name)


def save(page: Page, comment: str) -> str:
    """Save what is new; returns its id."""
    page.get_by_test_id("comment").fill(comment)
    page.get_by_test_id("save").click()
    expect(page.get_by_test_id("revision")).to_have_text("Revision 1")
    return page.url.rpartition("/")[2]


def saved(page: Page, console: ConsoleProcess, name: str) -> str:
    begin(page, console, name)
    expect(page.get_by_test_id("save-state")).to_have_text("not saved")
    return save(page, "first")


def test_a_test_is_written_by_form_and_its_peak_is_seen(
    page: Page, console: ConsoleProcess
) -> None:
    begin(page, console, "Written by form")
    row(page, "blocks[1]").click()
    key(page, "blocks[1].amplitude_n").fill("3,5")
    expect(page.get_by_test_id("preview-peak")).to_have_text(re.compile(r"3\.50"))
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile("amplitude_n: 3500"))
    page.get_by_test_id("add-blocks-layers").click()
    page.locator('[data-cell="0,0"]').focus()
    page.evaluate(PASTE, SPECTRUM)
    expect(page.get_by_test_id("layers-total")).to_have_text(re.compile("3 layers, 170 cycles"))
    expect(page.get_by_test_id("preview-peak")).to_have_text(re.compile(r"6\.00"))
    expect(page.get_by_test_id("preview")).to_have_attribute("data-stale", "false")
    test_id = save(page, "by form")
    layers = console.http.get(f"/tests/{test_id}").json()["definition"]["blocks"][2]["layers"]
    assert [(one["mean_n"], one["amplitude_n"], one["cycles"]) for one in layers] == [
        (0, 2000, 50),
        (1500, 3000, 100),
        (-2000, 4000, 20),
    ]


def keys_of(value: Any, path: str) -> list[str]:
    """The path of every figure and word of a definition, as the form names its fields."""
    if isinstance(value, dict):
        return [found for name, item in value.items() for found in keys_of(item, f"{path}.{name}")]
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [found for i, item in enumerate(value) for found in keys_of(item, f"{path}[{i}]")]
    return [path]


def test_a_frequency_response_that_adapts_is_edited_by_form(
    page: Page, console: ConsoleProcess
) -> None:
    library = yaml.safe_load(console.http.get("/tests/frequency-response-adaptive").json()["yaml"])
    page.goto(f"{console.url}/#/tests/frequency-response-adaptive")
    row(page, "blocks[0]").click()
    shown = [
        at for at in keys_of(library["blocks"][0], "blocks[0]") if not at.endswith(WITHOUT_FIELD)
    ]
    assert len(shown) > 20
    for path in shown:
        expect(key(page, path), path).to_be_visible()

    key(page, "blocks[0].confidence.gain_db").fill("0,03")
    key(page, "blocks[0].auto_level").uncheck()
    key(page, "blocks[0].means_n").fill("0 2,5")
    page.get_by_test_id("add-band").click()
    key(page, "blocks[0].bands[2].to_hz").fill("30")  # it begins above that
    expect(page.get_by_test_id("bands")).to_contain_text("must be above from_hz")
    key(page, "blocks[0].bands[2].from_hz").fill("20")
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile("from_hz: 20, to_hz: 30"))
    page.get_by_test_id("comment").fill("surer")
    page.get_by_test_id("save").click()
    expect(page.get_by_test_id("revision")).to_have_text("Revision 2")
    kept = console.http.get("/tests/frequency-response-adaptive").json()["definition"]["blocks"][0]
    assert kept["confidence"] == {"gain_db": 0.03, "phase_deg": 0.5}
    assert ("auto_level" in kept, kept["means_n"]) == (False, [0, 2500])
    assert [band["to_hz"] for band in kept["bands"]] == [40, 100, 30]
    assert kept["settle"]["at_most_cycles"] == 20

    key(page, "blocks[0].method").select_option("multisine")
    expect(key(page, "blocks[0].realisations")).to_be_visible()
    expect(key(page, "blocks[0].confidence")).to_have_count(0)
    expect(page.get_by_test_id("yaml")).not_to_have_value(re.compile("confidence"))


def test_what_is_wrong_is_said_at_the_field_and_at_the_line(
    page: Page, console: ConsoleProcess
) -> None:
    begin(page, console, "Too much")
    expect(page.get_by_test_id("preview-duration")).to_be_visible()
    row(page, "blocks[1]").click()
    key(page, "blocks[1].amplitude_n").fill("60")
    said = page.get_by_test_id("fields-blocks[1]").get_by_test_id("said")
    expect(said).to_have_text(re.compile("60 kN must be at most 50 kN"))
    expect(page.get_by_test_id("faults")).to_contain_text("blocks[1].amplitude_n")
    expect(page.get_by_test_id("save")).to_have_attribute("aria-disabled", "true")
    expect(page.get_by_test_id("preview")).to_have_attribute("data-stale", "true")
    page.keyboard.press("Control+z")
    expect(said).to_have_count(0)
    expect(key(page, "blocks[1].amplitude_n")).to_have_value("2")
    page.get_by_test_id("yaml").fill("schema: 1\nname: x\nblocks:\n  - {kind: hld}\n")
    expect(page.get_by_test_id("faults")).to_contain_text(re.compile("Line 4.*did you mean hold"))


def test_blocks_are_moved_with_keys(page: Page, console: ConsoleProcess) -> None:
    begin(page, console, "Moved")
    page.get_by_test_id("add-blocks-repeat").click()
    row(page, "blocks[1]").focus()
    page.keyboard.press("Alt+ArrowDown")
    expect(row(page, "blocks[1].blocks[0]")).to_be_focused()
    expect(row(page, "blocks[1].blocks[0]")).to_contain_text("Harmonic")
    page.keyboard.press("Control+d")
    expect(row(page, "blocks[1].blocks[1]")).to_contain_text("Harmonic")
    page.keyboard.press("Delete")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    expect(row(page, "blocks[1].blocks[0]")).to_contain_text("Harmonic")
    expect(row(page, "blocks[1].blocks[1]")).to_contain_text("Hold")


def test_comments_are_not_lost_unasked(page: Page, console: ConsoleProcess) -> None:
    begin(page, console, "x")
    page.get_by_test_id("yaml").fill(COMMENTED)
    expect(page.get_by_test_id("comments-notice")).to_contain_text("a comment")
    expect(page.get_by_test_id("test-name")).to_be_disabled()
    expect(page.get_by_test_id("test-name")).to_have_value("With a comment")
    page.get_by_test_id("accept-loss").click()
    page.get_by_test_id("test-name").fill("Without")
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile("^schema: 1\nname: Without\n"))
    page.get_by_test_id("undo").click()
    expect(page.get_by_test_id("yaml")).to_have_value(COMMENTED)


def test_two_who_save_the_same_test_lose_no_edit(page: Page, console: ConsoleProcess) -> None:
    test_id = saved(page, console, "Shared")
    theirs = console.http.get(f"/tests/{test_id}").json()["definition"]
    theirs["blocks"][1]["amplitude_n"] = 3000
    body = {"definition": theirs, "based_on": 1, "author": "Kim", "comment": "more"}
    assert console.http.put(f"/tests/{test_id}", json=body).is_success

    row(page, "blocks[1]").click()
    key(page, "blocks[1].amplitude_n").fill("1.5")
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile("amplitude_n: 1500"))
    with page.expect_response("**/tests/shared*") as answer:
        page.get_by_test_id("save").click()
    assert answer.value.status == 409
    conflict = page.get_by_test_id("conflict")
    expect(conflict).to_contain_text("Kim saved revision 2")
    page.get_by_test_id("conflict-difference").click()
    changes = conflict.get_by_test_id("difference").locator("tbody tr")
    expect(changes).to_have_count(1)
    expect(changes).to_have_text(re.compile(r"blocks\[1\]\.amplitude_n\s*3.kN\s*1\.5.kN"))

    page.get_by_test_id("conflict-save").click()
    expect(page.get_by_test_id("revision")).to_have_text("Revision 3")
    expect(conflict).to_have_count(0)
    page.get_by_test_id("tab-revisions").click()
    page.get_by_test_id("revision-2").get_by_role("button", name="What changed").click()
    shown = page.get_by_test_id("revision-2").get_by_test_id("difference")
    expect(shown).to_contain_text(re.compile(r"amplitude_n\s*2.kN\s*3.kN"))
    assert [one["number"] for one in console.http.get(f"/tests/{test_id}/revisions").json()] == [
        3,
        2,
        1,
    ]


def test_a_reload_keeps_the_draft(page: Page, console: ConsoleProcess) -> None:
    test_id = saved(page, console, "Kept")
    row(page, "blocks[0]").click()
    key(page, "blocks[0].duration_s").fill("0.75")
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile(r"duration_s: 0\.75"))
    page.reload()
    expect(page.get_by_test_id("draft-notice")).to_be_visible()
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile(r"duration_s: 0\.75"))
    expect(page.get_by_test_id("save-state")).to_have_text("not saved")
    page.goto(f"{console.url}/#/tests")
    expect(page.get_by_test_id(f"entry-{test_id}")).to_contain_text("Draft not saved")
    page.goto(f"{console.url}/#/tests/{test_id}")
    page.get_by_test_id("discard-draft").click()
    expect(page.get_by_test_id("save-state")).to_have_text("saved")
    expect(page.get_by_test_id("yaml")).to_have_value(re.compile(r"duration_s: 0\.5\b"))


def test_the_library_is_searched_and_opened_with_keys(page: Page, console: ConsoleProcess) -> None:
    page.goto(f"{console.url}/#/tests")
    expect(page.get_by_test_id("entry-hold-50-kn")).to_be_visible()
    page.keyboard.press("/")
    page.keyboard.type("hold 50")
    expect(page.get_by_test_id("library").locator("tbody tr")).to_have_count(1)
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Space")
    expect(page.get_by_test_id("export-tests")).to_have_text(re.compile("Export 1"))
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("test-name")).to_have_value("Hold of 50 kN")
    page.get_by_test_id("operate").click()
    expect(page.get_by_test_id("test-hold-50-kn")).to_contain_text("Hold of 50 kN")
