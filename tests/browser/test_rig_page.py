"""The Rig page: configuration, static and linear analysis, and the rig in three dimensions."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import pytest
from playwright.sync_api import Browser, Page, WebSocket, expect, sync_playwright

from tests.browser.conftest import FLAGS, REFUSED, chromium, watched
from tests.browser.session import take_command
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.browser, pytest.mark.slow]
PATIENCE_MS = 60_000
DRAWN = [flag for flag in FLAGS if flag != "--disable-gpu"]
SOFTWARE = [
    *("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
    "--disable-gpu-compositing",  # the rest of the page is drawn without
]
NO_EVAL = "Evaluating a string as JavaScript"  # viser's splat sorter, which nothing here needs


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A browser that draws in three dimensions, by the processor."""
    path = chromium()
    if path is None:
        pytest.skip("no Chromium: make test installs one where it may")
    with sync_playwright() as playwright:
        made = playwright.chromium.launch(executable_path=path, args=[*DRAWN, *SOFTWARE])
        yield made
        made.close()


@contextmanager
def opened(browser: Browser, console: ConsoleProcess, *expected: str) -> Iterator[Page]:
    """A page of somebody who has signed in."""
    with watched(browser, console, REFUSED, NO_EVAL, *expected) as page:
        page.context.request.get(console.url + console.new_link())
        page.set_viewport_size({"width": 800, "height": 500})
        page.set_default_timeout(PATIENCE_MS)
        yield page


@pytest.fixture
def page(browser: Browser, console: ConsoleProcess) -> Iterator[Page]:
    with opened(browser, console) as page:
        yield page


def test_the_configuration_is_changed_as_a_draft_and_put_in_force_with_a_reason(
    console: ConsoleProcess, page: Page
) -> None:
    page.goto(f"{console.url}/#/rig/configuration")
    take_command(page)
    page.get_by_test_id("edit-configuration").click()
    page.locator("[data-path='unit_under_test.serial_number']").fill("TRA-7")
    expect(page.get_by_test_id("configuration-changes")).to_contain_text("TRA-7")
    page.get_by_test_id("configuration-why").fill("Another unit")
    page.get_by_test_id("apply-configuration").click()
    expect(page.get_by_test_id("configuration-save")).to_be_hidden()
    found = console.http.get("/rig-configuration").json()
    assert found["document"]["unit_under_test"]["serial_number"] == "TRA-7"
    assert found["why"] == "Another unit"
    page.get_by_test_id("configuration-history").click()
    expect(page.locator("table")).to_contain_text("Another unit")


def test_the_rigs_own_orifice_is_among_the_static_characteristics(
    console: ConsoleProcess, page: Page
) -> None:
    page.goto(f"{console.url}/#/rig/static")
    chart = page.get_by_test_id("static-force_n")
    expect(chart.locator(".marked")).to_have_text("0.85 mm")
    expect(chart.locator(".one")).to_have_count(5)


def test_the_loop_has_the_margins_of_the_rigs_sheet(console: ConsoleProcess, page: Page) -> None:
    page.goto(f"{console.url}/#/rig/linear")
    row = page.get_by_test_id("loop-table").locator("tbody tr").nth(1)  # 2 kN
    for figure in ("2.00", "279", "1.68", "10.0", "1.58"):
        expect(row).to_contain_text(figure)


class SceneFrames:
    """How many messages the view's socket has brought."""

    def __init__(self, page: Page) -> None:
        self._page, self._count = page, 0
        page.on("websocket", self._opened)

    def any(self) -> None:
        """Wait for the first, if it has not been there."""
        wait_for(lambda: self._seen() > 0, "the rig's parts")

    def more(self, what: str, do: Callable[[], None]) -> None:
        """Wait until something has brought another."""
        before = self._count
        do()
        wait_for(lambda: self._seen() > before, what)

    def _seen(self) -> int:
        self._page.wait_for_timeout(200)  # in which playwright hears of them
        return self._count

    def _opened(self, socket: WebSocket) -> None:
        if "/scene" in socket.url:
            socket.on("framereceived", self._heard)

    def _heard(self, _: object) -> None:
        self._count += 1


@pytest.mark.timeout(600)  # the page draws with the processor; no picture is waited for
def test_the_view_is_shown_and_moves_with_a_run(console: ConsoleProcess, page: Page) -> None:
    console.make_ready()
    run_id = console.start_run("step-2-kn")
    console.ended_run(run_id)
    frames = SceneFrames(page)
    page.goto(f"{console.url}/#/rig/view")
    page.get_by_test_id("scene-run").select_option(str(run_id))
    page.get_by_test_id("scene-anyway").dispatch_event("click")
    frame = page.frame_locator("[data-testid=scene-frame]")
    expect(frame.locator("canvas").first).to_be_attached(timeout=3 * PATIENCE_MS)
    frames.any()
    for moment in ("0.3", "1"):
        slider = page.get_by_test_id("scene-time")
        frames.more("it to move", partial(slider.fill, moment))


def test_the_page_says_what_has_become_of_the_view(
    browser: Browser, console: ConsoleProcess
) -> None:
    with opened(browser, console, "net::ERR_FAILED") as page:
        page.route("**/api/v1/scene*", lambda route: route.abort())
        page.route("**/api/v1/scene/**", lambda route: route.abort())
        page.goto(f"{console.url}/#/rig/view")
        page.get_by_test_id("scene-anyway").dispatch_event("click")  # which waits for no picture
        expect(page.get_by_test_id("scene-detail")).to_contain_text("does not answer")
        expect(page.get_by_test_id("stop")).to_be_enabled()
