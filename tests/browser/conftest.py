"""A real console, and a real browser that looks at it."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Page, Request, sync_playwright

from tests.console_process import OF_FOLDER, ConsoleProcess

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = [
    *("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
]
REFUSED = "status of 409"  # Chromium's word for an answer that the page has asked for and shows
BUILT = Path(__file__).parents[2] / "app" / "static" / "index.html"


def chromium() -> str | None:
    """The browser that `make test` found, or the first one on the PATH."""
    found = (shutil.which(name) for name in NAMES)
    return os.environ.get("FORCERIG_CHROMIUM") or next((path for path in found if path), None)


@pytest.fixture(scope="session")
def console(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ConsoleProcess]:
    if not BUILT.exists():
        pytest.skip("the console has not been built: make test builds it")
    process = ConsoleProcess(tmp_path_factory.mktemp("console"))
    try:
        OF_FOLDER[Path(__file__).parent] = process
        yield process.start()
    finally:
        process.clean_up()


@pytest.fixture(scope="module")  # while it is open, no other test may run an event loop
def browser() -> Iterator[Browser]:
    path = chromium()
    if path is None:
        pytest.skip("no Chromium: make test installs one where it may")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@contextmanager
def watched(browser: Browser, console: ConsoleProcess, *expected: str) -> Iterator[Page]:
    """A page in a browser of its own. Fails where it had another error than expected, or asked another site."""
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    page = context.new_page()
    complaints: list[str] = []
    own = (console.url, console.status()["stop_url"], "data:", "blob:")

    def complain(text: str) -> None:
        if not any(word in text for word in expected):
            complaints.append(text)

    def heard(message: ConsoleMessage) -> None:
        if message.type == "error":
            complain(message.text)

    def asked(request: Request) -> None:
        if not request.url.startswith(own):
            complaints.append(f"asked {request.url}")

    page.on("console", heard)
    page.on("pageerror", lambda error: complain(str(error)))
    page.on("request", asked)
    yield page
    context.close()
    assert complaints == []


@pytest.fixture
def page(browser: Browser, console: ConsoleProcess) -> Iterator[Page]:
    """A page of the console, of an admin who is signed in."""
    with watched(browser, console, REFUSED) as page:
        page.context.request.get(console.url + console.new_link())
        yield page
