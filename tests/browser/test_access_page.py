"""Who comes in, who is in command, and what a page says of both: several people, a browser each."""

import re
from collections.abc import Iterator
from contextlib import ExitStack

import httpx2
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import REFUSED, watched
from tests.browser.people import PASSWORD, come_in, enter, type_in
from tests.browser.session import is_at
from tests.console_process import ConsoleProcess, bearer

pytestmark = [pytest.mark.browser, pytest.mark.process, pytest.mark.slow]
PATIENCE_MS = 30_000
NOT_IN = ("status of 401", "status of 403", "status of 429", "WebSocket", REFUSED)


@pytest.fixture(autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="module")
def people(console: ConsoleProcess) -> dict[str, int]:
    """Somebody of each role, and their numbers."""
    roles = {"Vic": "viewer", "Ann": "operator", "Eva": "engineer", "Ada": "admin"}
    return {name: enter(console, name, role) for name, role in roles.items()}


class Screens:
    """Opens pages, each in a browser of its own."""

    def __init__(self, stack: ExitStack, browser: Browser, console: ConsoleProcess) -> None:
        self._stack, self._browser, self._console = stack, browser, console

    def new(self) -> Page:
        """A page on which nobody is signed in."""
        return self._stack.enter_context(watched(self._browser, self._console, *NOT_IN))

    def of(self, name: str, where: str = "") -> Page:
        """A page of somebody who is signed in."""
        page = self.new()
        come_in(page, self._console, name, where)
        return page


@pytest.fixture
def screens(browser: Browser, console: ConsoleProcess, people: dict[str, int]) -> Iterator[Screens]:
    """A rig that is ready, and nobody in command."""
    console.make_ready()
    console.http.delete("/lease")
    with ExitStack() as stack:
        yield Screens(stack, browser, console)


# ---- coming in and going out ----


def test_whoever_signs_in_comes_to_where_they_wanted(
    screens: Screens, console: ConsoleProcess
) -> None:
    page = screens.new()
    page.goto(f"{console.url}/#/runs?search=hold")
    expect(page.get_by_test_id("sign-in")).to_contain_text("forcerig stop")
    expect(page.get_by_test_id("sign-in")).to_contain_text("hard-wired chain")
    expect(page.get_by_test_id("stop")).to_have_count(0)
    type_in(page, "Ann", "not her password")
    expect(page.get_by_test_id("sign-in-failure")).to_have_text("Name or password is wrong")
    expect(page.get_by_test_id("sign-in-password")).to_be_focused()
    type_in(page, "Ann")
    expect(page.get_by_test_id("account")).to_have_text(re.compile(r"Ann\s*operator"))
    expect(page.get_by_test_id("nav-runs")).to_have_attribute("aria-current", "page")
    assert page.url.endswith("#/runs?search=hold")


def test_too_many_attempts_have_to_wait_and_see_how_long(
    screens: Screens, console: ConsoleProcess
) -> None:
    enter(console, "Tim", "viewer")
    page = screens.new()
    page.goto(console.url)
    button = page.get_by_test_id("sign-in-submit")
    for _ in range(10):
        expect(button).to_have_text("Sign in")
        with page.expect_response("**/auth/login") as answer:
            type_in(page, "Tim", "guessed")
        if answer.value.status == 429:
            break
    expect(page.get_by_test_id("sign-in-failure")).to_contain_text("Too many attempts")
    expect(button).to_have_text("Sign in")  # once the time is over
    type_in(page, "Tim")
    expect(page.get_by_test_id("account")).to_contain_text("Tim")


def test_signing_out_leaves_nothing_to_see(screens: Screens, console: ConsoleProcess) -> None:
    page = screens.of("Ann")
    page.get_by_test_id("account").click()
    page.get_by_test_id("sign-out").click()
    expect(page.get_by_test_id("session-ended")).to_have_text("You have signed out.")
    expect(page.get_by_test_id("mode")).to_be_hidden()
    page.reload()
    expect(page.get_by_test_id("sign-in-name")).to_be_focused()
    assert page.request.get(f"{console.url}/api/v1/rig").status == 401


def test_a_session_revoked_while_one_looks_loses_nothing(
    screens: Screens, console: ConsoleProcess
) -> None:
    page = screens.of("Ann", "/#/system/tokens")
    page.get_by_test_id("token-name").fill("night series")
    sessions = console.http.get("/sessions").json()
    for one in sessions:
        if one["user"] == "Ann":
            assert console.http.delete(f"/sessions/{one['id']}").status_code == 204
    expect(page.get_by_test_id("session-ended")).to_contain_text("Nothing that you typed is lost")
    expect(page.get_by_test_id("sign-in-name")).to_have_value("Ann")
    expect(page.get_by_test_id("force")).to_be_hidden()
    type_in(page, "Ann")
    expect(page.get_by_test_id("token-name")).to_have_value("night series")
    expect(page.get_by_test_id("stale-banner")).to_have_count(0)


def test_the_first_sign_in_by_link_asks_for_a_password(
    screens: Screens, console: ConsoleProcess
) -> None:
    made = console.http.post("/users", json={"name": "Lin", "role": "operator"})
    link = console.http.post(f"/users/{made.json()['id']}/link").json()["path"]
    page = screens.new()
    page.goto(console.url + link)
    expect(page.get_by_test_id("first-password")).to_contain_text("Set a password for Lin")
    page.get_by_test_id("password-new").fill("short")
    page.get_by_test_id("password-new").fill(PASSWORD)
    page.get_by_test_id("password-save").click()
    expect(page.get_by_test_id("first-password")).to_have_count(0)
    page.get_by_test_id("account").click()
    page.get_by_test_id("sign-out").click()
    type_in(page, "Lin")
    expect(page.get_by_test_id("account")).to_contain_text("Lin")


# ---- who is in command ----


def test_control_is_taken_asked_for_given_kept_and_taken_over(screens: Screens) -> None:
    ann, eva = screens.of("Ann"), screens.of("Eva", "/#/system/loop")
    expect(ann.get_by_test_id("holder")).to_have_text("Nobody")
    expect(ann.get_by_test_id("cmd-depressurise")).to_have_attribute("aria-disabled", "true")
    ann.keyboard.press("c")
    ann.get_by_test_id("take-reason").fill("Morning series")
    ann.keyboard.press("Enter")
    expect(ann.get_by_test_id("holder")).to_have_text("You")

    expect(eva.get_by_test_id("holder")).to_have_text("Ann")
    eva.keyboard.press("c")
    expect(eva.get_by_label("Command of the rig")).to_contain_text("Morning series")
    eva.get_by_test_id("ask-reason").fill("To look at the valve")
    eva.keyboard.press("Enter")
    expect(ann.get_by_test_id("request")).to_contain_text(
        "Eva asks for command. To look at the valve"
    )
    expect(ann.get_by_test_id("request")).to_contain_text(re.compile(r"\d+ s left"))
    expect(eva.get_by_test_id("asked")).to_contain_text("You asked Ann")
    ann.get_by_test_id("give").click()
    expect(eva.get_by_test_id("holder")).to_have_text("You")
    expect(eva.get_by_test_id("control-notice")).to_have_text(re.compile("You are in command now"))
    expect(ann.get_by_test_id("holder")).to_have_text("Eva")
    expect(ann.get_by_test_id("control-notice")).to_have_count(0)
    expect(ann.locator("#why-depressurise")).to_contain_text("Eva is in command")

    ann.keyboard.press("c")
    expect(ann.get_by_test_id("take-over")).to_have_attribute("aria-disabled", "true")
    expect(ann.locator("#ask-against")).to_contain_text("Needs an engineer; you are an operator")
    ann.get_by_test_id("ask").click()
    eva.get_by_test_id("keep").click()
    expect(ann.get_by_test_id("control-notice")).to_contain_text("Eva keeps control")

    eva.keyboard.press("c")
    eva.get_by_test_id("release").click()
    expect(ann.get_by_test_id("holder")).to_have_text("Nobody")
    ann.keyboard.press("c")
    ann.get_by_test_id("take").click()
    expect(ann.get_by_test_id("holder")).to_have_text("You")

    expect(eva.get_by_test_id("holder")).to_have_text("Ann")
    eva.keyboard.press("c")
    expect(eva.locator("#ask-against")).to_contain_text("Taking over needs a reason")
    eva.get_by_test_id("ask-reason").fill("Oil leaks")
    eva.get_by_test_id("take-over").click()
    expect(eva.get_by_test_id("holder")).to_have_text("You")
    expect(ann.get_by_test_id("control-notice")).to_contain_text(
        "Control has passed to Eva, engineer. Reason: Oil leaks"
    )


def test_a_reload_keeps_command_and_another_window_has_none_of_it(screens: Screens) -> None:
    ann = screens.of("Ann")
    ann.keyboard.press("c")
    ann.get_by_test_id("take").click()
    expect(ann.get_by_test_id("holder")).to_have_text("You")
    ann.reload()
    expect(ann.get_by_test_id("holder")).to_have_text("You")
    other = ann.context.new_page()
    other.goto(ann.url)
    expect(other.get_by_test_id("holder")).to_have_text("You, elsewhere")
    expect(other.locator("#why-depressurise")).to_contain_text("another window")


def test_a_viewer_stops_a_run_that_somebody_else_commands(
    screens: Screens, console: ConsoleProcess
) -> None:
    layer = {"mean_n": 0, "amplitude_n": 500, "frequency_hz": 10, "cycles": 10}
    blocks = [{"kind": "layers", "layers": [layer], "repeats": 500, "transition_s": 0.2}]
    definition = {"schema": 1, "name": "Long enough to stop", "blocks": blocks}
    made = console.http.post("/tests", json={"definition": definition}).json()
    start = {"test_id": made["id"], "override_reason": "It is to be stopped"}
    vic = screens.of("Vic", "/#/system/audit")
    expect(vic.get_by_test_id("audit-lacking")).to_contain_text(
        "Needs an engineer; you are a viewer"
    )
    console.take_command()
    answer = console.http.post("/runs", json=start)
    assert answer.status_code == 201, answer.text
    is_at(vic, "running")
    vic.get_by_test_id("stop").click()
    expect(vic.get_by_test_id("stop-state")).to_have_text("Sent")
    is_at(vic, "ready")
    assert console.ended_run(answer.json()["id"])["outcome"] == "stopped"
    vic.get_by_test_id("nav-operate").click()
    expect(vic.locator("#why-depressurise")).to_contain_text("Needs an operator; you are a viewer")


# ---- the System page ----


def test_an_admin_adds_somebody_who_comes_in_by_the_link(
    screens: Screens, console: ConsoleProcess
) -> None:
    ada = screens.of("Ada", "/#/system/users")
    ada.get_by_test_id("user-name").fill("Bo")
    ada.get_by_test_id("user-role").select_option("viewer")
    ada.get_by_test_id("user-add").click()
    link = ada.get_by_test_id("user-link").input_value()
    assert link.startswith(f"{console.url}/sign-in?token=")
    bo = screens.new()
    bo.goto(link)
    expect(bo.get_by_test_id("account")).to_have_text(re.compile(r"Bo\s*viewer"))
    bo.get_by_test_id("nav-system").click()
    expect(bo.get_by_test_id("users-lacking")).to_contain_text("Needs an admin; you are a viewer")
    ada.get_by_test_id("disable-Bo").click()
    ada.get_by_test_id("disable-Bo").click()
    expect(ada.get_by_test_id("user-Bo")).to_contain_text("no, disabled")
    expect(bo.get_by_test_id("session-ended")).to_be_visible()


def test_a_token_is_shown_once_and_revoked(screens: Screens, console: ConsoleProcess) -> None:
    ann = screens.of("Ann", "/#/system/tokens")
    expect(
        ann.get_by_test_id("token-scope").locator("option", has_text="engineer")
    ).to_be_disabled()
    ann.get_by_test_id("token-name").fill("dashboard")
    ann.get_by_test_id("token-make").click()
    token = ann.get_by_test_id("token-made").input_value()
    rig = f"{console.url}/api/v1/rig"
    assert httpx2.get(rig, headers=bearer(token)).status_code == 200
    ann.reload()
    expect(ann.get_by_test_id("tokens")).to_contain_text("dashboard")
    expect(ann.get_by_test_id("token-made")).to_have_count(0)
    ann.get_by_test_id("revoke-dashboard").click()
    ann.get_by_test_id("revoke-dashboard").click()
    expect(ann.get_by_test_id("tokens")).to_have_count(0)
    assert httpx2.get(rig, headers=bearer(token)).status_code == 401


def test_the_audit_says_what_was_before_and_after(
    screens: Screens, console: ConsoleProcess, people: dict[str, int]
) -> None:
    changed = console.http.patch(f"/users/{people['Vic']}", json={"role": "operator"})
    assert changed.is_success
    assert console.http.patch(f"/users/{people['Vic']}", json={"role": "viewer"}).is_success
    eva = screens.of("Eva", "/#/system/audit")
    expect(eva.get_by_test_id("chain-verdict")).to_contain_text("Verified")
    eva.get_by_test_id("audit-action").fill("users.")
    expect(eva.get_by_test_id("audit")).not_to_contain_text("tests.")
    eva.get_by_test_id("audit").get_by_role("button").first.click()
    expect(eva.get_by_test_id("audit-changes")).to_contain_text(
        re.compile("role.*operator.*viewer")
    )
    eva.get_by_test_id("audit-search").fill("nothing has this")
    expect(eva.get_by_text("No entry has all of that")).to_be_visible()


def test_loop_and_doctor_say_how_the_machine_does(screens: Screens) -> None:
    vic = screens.of("Vic", "/#/system/loop")
    expect(vic.get_by_test_id("histogram-wakeup").locator("canvas")).to_be_visible()
    expect(vic.get_by_test_id("histogram-tick").locator("canvas")).to_be_visible()
    expect(vic.get_by_test_id("loop-percentiles")).to_contain_text("99.9 %")
    vic.get_by_test_id("tab-doctor").click()
    expect(vic.get_by_test_id("doctor-verdict")).not_to_be_empty()
    expect(vic.get_by_test_id("findings")).to_contain_text("clock source")
