"""What another page, another's ticket or two credentials at once ask for: each refused by every door."""

from collections.abc import Iterator
from typing import Any
from urllib.parse import quote

import httpx2
import pytest

from tests.api.test_access import Person, hears, told
from tests.console_process import ConsoleProcess, bearer

pytestmark = [pytest.mark.process, pytest.mark.slow]
FOREIGN = {"Origin": "http://evil.example"}
SIGN_IN = "/api/v1/auth/login"  # where nobody has a credential yet: test_access.py


@pytest.fixture(scope="module")
def admin(console: ConsoleProcess) -> Iterator[Person]:
    """May do everything: what keeps them from it is not their role."""
    made = Person(console, "admin").sign_in()
    yield made
    made.browser.close()


@pytest.fixture(scope="module")
def changing(console: ConsoleProcess) -> list[tuple[str, str]]:
    """Every operation that changes something, as method and address."""
    paths: dict[str, dict[str, Any]] = console.http.get(f"{console.url}/openapi.json").json()[
        "paths"
    ]
    return [
        (method.upper(), console.url + path.replace("{", "").replace("}", ""))
        for path, methods in paths.items()
        for method in methods
        if method != "get" and path != SIGN_IN
    ]


def refusals(person: Person, asked: list[tuple[str, str]], **headers: str) -> set[tuple[int, str]]:
    """All that was said when everything was asked with these headers."""
    wanted = dict(person.browser.headers) | headers
    return {told(person.browser.request(*one, json={}, headers=wanted)) for one in asked}


def test_no_operation_is_done_without_the_token_of_ones_own_page(
    console: ConsoleProcess, admin: Person, changing: list[tuple[str, str]]
) -> None:
    other = Person(console, "admin").sign_in()
    elsewhere = other.me()["csrf_token"]
    assert len(changing) > 30
    for given in ("", "wrong", elsewhere):
        assert refusals(admin, changing, **{"x-csrf-token": given}) == {(403, "csrf")}


@pytest.mark.parametrize(
    "headers", [FOREIGN, {"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}], ids=str
)
def test_no_operation_is_done_for_another_page(
    admin: Person, changing: list[tuple[str, str]], headers: dict[str, str]
) -> None:
    assert refusals(admin, changing, **headers) == {(403, "foreign_origin")}


def test_no_operation_is_done_with_two_credentials(
    console: ConsoleProcess, admin: Person, changing: list[tuple[str, str]]
) -> None:
    both = bearer(console.token)
    assert refusals(admin, changing, **both) == {(400, "two_credentials")}


def test_the_live_stream_is_not_for_another_page_whatever_it_brings(
    console: ConsoleProcess, admin: Person
) -> None:
    ticket = admin.browser.post("/auth/ticket").json()["ticket"]
    assert not hears(console, **bearer(console.token), **FOREIGN)
    assert not hears(console, **admin.cookies, Origin="null")
    assert not hears(console, f"?ticket={ticket}", **FOREIGN)
    assert not hears(console, f"?ticket={ticket}", **bearer(console.token))
    assert hears(console, f"?ticket={ticket}")
    assert not hears(console, f"?ticket={ticket}")


def test_a_ticket_goes_with_whoever_took_it(console: ConsoleProcess) -> None:
    person = Person(console).sign_in()
    ticket = person.browser.post("/auth/ticket").json()["ticket"]
    assert person.browser.post("/auth/logout").is_success
    assert not hears(console, f"?ticket={ticket}")


def test_stop_on_its_own_port_is_not_for_another_page(
    console: ConsoleProcess, admin: Person
) -> None:
    url = console.status()["stop_url"]

    def stop(**headers: str) -> tuple[int, str]:
        answer = httpx2.post(url, headers=headers)
        assert "access-control-allow-origin" not in answer.headers
        return told(answer)

    for origin in ("http://evil.example", "null", url.removesuffix("/stop")):
        assert stop(**admin.cookies, Origin=origin) == (403, "foreign_origin")
        assert stop(**bearer(console.token), Origin=origin) == (403, "foreign_origin")
    assert stop(**admin.cookies, **bearer(console.token)) == (400, "two_credentials")
    assert stop(**{"Sec-Fetch-Site": "cross-site"}, **admin.cookies) == (403, "foreign_origin")
    ticket = admin.browser.post("/auth/ticket").json()["ticket"]
    assert told(httpx2.post(f"{url}?ticket={ticket}")) == (401, "not_signed_in")


ELSEWHERE = [
    *(
        "../forcerig.sqlite",
        "../../etc/passwd.csv",
        "/etc/passwd.csv",
        "a/../../b.csv",
        "..\\b.csv",
    ),
    *("%2e%2e%2fb.csv", "..", ".", "b.csv\0.csv", "b.csv\n", "file:///etc/passwd"),
]


@pytest.mark.parametrize("name", ELSEWHERE)
def test_no_history_leads_elsewhere(console: ConsoleProcess, name: str) -> None:
    files = sorted(console.data.parent.rglob("*.csv")), sorted(console.data.parent.rglob("*.npy"))
    sent = console.http.post(f"/histories?rate_hz=10&name={quote(name)}", content="f\n1\n2\n")
    assert 400 <= sent.status_code < 500, sent.text
    now = sorted(console.data.parent.rglob("*.csv")), sorted(console.data.parent.rglob("*.npy"))
    assert now == files
    test = {"schema": 1, "name": "Elsewhere", "blocks": [{"kind": "time_history", "file": name}]}
    answer = console.http.post("/tests/check", json={"definition": test})
    assert answer.is_client_error or not answer.json()["valid"]
    assert "root:" not in answer.text
