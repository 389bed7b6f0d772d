"""People at the screen, each in a browser of their own, for the tests of who may what."""

from playwright.sync_api import Page, expect

from tests.console_process import ConsoleProcess

PASSWORD = "four plain words together"


def enter(console: ConsoleProcess, name: str, role: str) -> int:
    """Enter somebody with the password of the tests; returns their number."""
    user = {"name": name, "role": role, "password": PASSWORD}
    made = console.http.post("/users", json=user)
    assert made.status_code == 201, made.text
    return int(made.json()["id"])


def type_in(page: Page, name: str, password: str = PASSWORD) -> None:
    """Fill in the sign-in, and send it."""
    page.get_by_test_id("sign-in-name").fill(name)
    page.get_by_test_id("sign-in-password").fill(password)
    page.get_by_test_id("sign-in-submit").click()


def come_in(page: Page, console: ConsoleProcess, name: str, where: str = "") -> None:
    """Open the console and sign in."""
    page.goto(console.url + where)
    type_in(page, name)
    expect(page.get_by_test_id("account")).to_contain_text(name)
    expect(page.get_by_test_id("sign-in")).to_have_count(0)
