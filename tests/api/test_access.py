"""Coming in and going out: sign-in, cookie, CSRF, tokens, and what ends a live stream."""

import json
from collections.abc import Callable, Iterator
from itertools import count
from typing import Any

import httpx2
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from app.access.principal import Role
from tests.console_process import ConsoleProcess, bearer

pytestmark = [pytest.mark.process, pytest.mark.slow]
PASSWORD = "correct horse battery"
PATIENCE_S = 30
NUMBERS = count(1)


class Person:
    """A user with a browser of their own."""

    def __init__(self, console: ConsoleProcess, role: str = "operator") -> None:
        self.name = f"person {next(NUMBERS)}"
        asked = {"name": self.name, "role": role, "password": PASSWORD}
        made = console.http.post("/users", json=asked)
        assert made.status_code == 201, made.text
        self.id = made.json()["id"]
        self.browser = console.client()

    def sign_in(self) -> "Person":
        """By name and password; from now on the page's token goes with every request."""
        asked = {"name": self.name, "password": PASSWORD}
        answer = self.browser.post("/auth/login", json=asked)
        assert answer.status_code == 204, answer.text
        self.browser.headers["X-CSRF-Token"] = self.me()["csrf_token"]
        return self

    def me(self) -> dict[str, Any]:
        found: dict[str, Any] = self.browser.get("/auth/me").json()
        return found

    @property
    def cookies(self) -> dict[str, str]:
        """What shows that it is they, for a WebSocket."""
        return {"Cookie": "; ".join(f"{n}={v}" for n, v in self.browser.cookies.items())}


@pytest.fixture
def person(console: ConsoleProcess) -> Iterator[Person]:
    made = Person(console).sign_in()
    yield made
    made.browser.close()


@pytest.fixture
def stranger(console: ConsoleProcess) -> Iterator[httpx2.Client]:
    with console.client() as client:
        yield client


def told(answer: httpx2.Response) -> tuple[int, str]:
    return answer.status_code, answer.json()["code"]


# ---- signing in and out ----


def test_a_person_signs_in_is_known_and_signs_out(console: ConsoleProcess) -> None:
    person = Person(console, "engineer")
    assert told(person.browser.get("/rig")) == (401, "not_signed_in")
    me = person.sign_in().me()
    assert (me["name"], me["role"], me["kind"]) == (person.name, "engineer", "session")
    assert me["must_set_password"] is False
    assert person.browser.get("/rig").is_success
    kept = dict(person.browser.cookies)
    assert person.browser.post("/auth/logout").status_code == 204
    assert dict(person.browser.cookies) == {}
    again = console.client()
    again.cookies.update(kept)
    assert told(again.get("/rig")) == (401, "not_signed_in")


def test_the_cookie_is_for_this_site_and_no_script(console: ConsoleProcess) -> None:
    person = Person(console)
    asked = {"name": person.name, "password": PASSWORD}
    said = person.browser.post("/auth/login", json=asked).headers["set-cookie"]
    parts = [part.strip().lower() for part in said.split(";")]
    assert {"httponly", "samesite=strict", "path=/"} <= set(parts)
    assert not any(part.startswith("domain") for part in parts)


def test_a_wrong_password_and_an_unknown_name_are_told_alike(
    console: ConsoleProcess, stranger: httpx2.Client
) -> None:
    person = Person(console)
    asked = [{"name": person.name, "password": PASSWORD + "x"}]
    asked += [{"name": "nobody at all", "password": PASSWORD}]
    wrong, unknown = (stranger.post("/auth/login", json=one) for one in asked)
    assert told(wrong) == (401, "sign_in_failed")
    assert wrong.json() == unknown.json()
    assert "set-cookie" not in wrong.headers


def test_guessing_is_slowed_down(console: ConsoleProcess, stranger: httpx2.Client) -> None:
    person = Person(console)
    wrong = {"name": person.name, "password": "not the password"}
    for _ in range(5):
        assert told(stranger.post("/auth/login", json=wrong)) == (401, "sign_in_failed")
    stranger.post("/auth/login", json=wrong)
    answers = [stranger.post("/auth/login", json=wrong) for _ in range(3)]
    slowed = [answer for answer in answers if answer.status_code == 429]
    assert slowed
    for answer in slowed:
        assert answer.json()["code"] == "too_many_attempts"
        assert int(answer.headers["retry-after"]) == answer.json()["retry_after_s"] >= 1


@pytest.mark.parametrize("kind", ["application/x-www-form-urlencoded", "text/plain"])
def test_only_json_signs_in(console: ConsoleProcess, stranger: httpx2.Client, kind: str) -> None:
    person = Person(console)
    body = json.dumps({"name": person.name, "password": PASSWORD})
    answer = stranger.post("/auth/login", content=body, headers={"Content-Type": kind})
    assert told(answer) == (422, "invalid_request")
    assert PASSWORD not in answer.text


def test_a_foreign_page_signs_nobody_in(console: ConsoleProcess, stranger: httpx2.Client) -> None:
    person = Person(console)
    asked = {"name": person.name, "password": PASSWORD}
    headers = {"Origin": "http://evil.example"}
    answer = stranger.post("/auth/login", json=asked, headers=headers)
    assert told(answer) == (403, "foreign_origin")


def test_a_password_is_changed_with_the_old_one_and_ends_the_other_sessions(
    console: ConsoleProcess, person: Person
) -> None:
    elsewhere = console.client()
    elsewhere.post("/auth/login", json={"name": person.name, "password": PASSWORD})
    assert elsewhere.get("/rig").is_success

    def change(**asked: str) -> httpx2.Response:
        return person.browser.post("/auth/password", json=asked)

    new = "another long one"
    assert told(change(new=new)) == (403, "wrong_password")
    assert told(change(old="not it at all", new=new)) == (403, "wrong_password")
    assert told(change(old=PASSWORD, new="short")) == (422, "weak_password")
    assert told(change(old=PASSWORD, new=person.name)) == (422, "weak_password")
    assert change(old=PASSWORD, new=new).status_code == 204
    assert person.browser.get("/rig").is_success
    assert told(elsewhere.get("/rig")) == (401, "not_signed_in")


# ---- the link ----


def test_a_link_lets_in_once_and_a_used_one_says_what_to_do(console: ConsoleProcess) -> None:
    path = console.new_link()
    with httpx2.Client(base_url=console.url) as browser:
        answer = browser.get(path)
        assert (answer.status_code, answer.headers["location"]) == (303, "/")
        assert answer.headers["cache-control"] == "no-store"
        me = browser.get("/api/v1/auth/me").json()
        assert (me["name"], me["must_set_password"]) == ("admin", True)
        for again in (path, "/sign-in?token=unknown", "/sign-in"):
            refused = browser.get(again)
            assert refused.status_code == 403
            assert "forcerig user link" in refused.text
            assert "set-cookie" not in refused.headers
        assert browser.get("/api/v1/auth/me").is_success


def test_the_console_said_at_its_start_how_to_come_in(console: ConsoleProcess) -> None:
    first, second, *_ = (line for line in console.said().splitlines() if console.url in line)
    assert first == f"forcerig console: {console.url}/"
    assert second.startswith(f"Sign in once with: {console.url}/sign-in?token=")


# ---- what goes with a change ----


@pytest.mark.parametrize("given", [None, "", "wrong"])
def test_a_change_without_the_pages_token_is_refused(person: Person, given: str | None) -> None:
    headers = {} if given is None else {"X-CSRF-Token": given}
    del person.browser.headers["X-CSRF-Token"]
    answer = person.browser.post("/rig/commands", json={"command": "stop"}, headers=headers)
    assert told(answer) == (403, "csrf")
    assert told(person.browser.delete("/tests/nowhere", headers=headers)) == (403, "csrf")
    assert person.browser.get("/rig", headers=headers).is_success


def test_a_token_of_another_session_is_not_the_pages(
    console: ConsoleProcess, person: Person
) -> None:
    other = Person(console).sign_in()
    headers = {"X-CSRF-Token": other.me()["csrf_token"]}
    answer = person.browser.post("/rig/commands", json={"command": "stop"}, headers=headers)
    assert told(answer) == (403, "csrf")


def test_a_foreign_page_changes_nothing_even_with_everything_else_right(person: Person) -> None:
    headers = {"Origin": "http://evil.example"}
    answer = person.browser.post("/rig/commands", json={"command": "stop"}, headers=headers)
    assert told(answer) == (403, "foreign_origin")


def test_two_credentials_are_refused_even_for_reading(
    console: ConsoleProcess, person: Person
) -> None:
    answer = person.browser.get("/rig", headers=console.headers)
    assert told(answer) == (400, "two_credentials")


def test_anybody_who_sees_the_rig_may_stop_it(console: ConsoleProcess) -> None:
    viewer = Person(console, "viewer").sign_in().browser
    assert viewer.post("/rig/commands", json={"command": "stop"}).is_success
    for command in ("reset", "shutdown", "pressurise"):
        answer = viewer.post("/rig/commands", json={"command": command})
        assert told(answer) == (403, "not_allowed")
        assert answer.json()["role_needed"] == "operator"


def test_only_an_engineer_overrides_a_prediction(console: ConsoleProcess) -> None:
    asked = {"test_id": "nowhere", "override_reason": "I know better"}
    with console.as_role(Role.OPERATOR) as operator, console.as_role(Role.ENGINEER) as engineer:
        assert told(operator.post("/runs", json=asked)) == (403, "not_allowed")
        assert told(engineer.post("/runs", json=asked))[1] != "not_allowed"


# ---- tokens ----


def test_a_token_is_shown_once_used_and_revoked(console: ConsoleProcess, person: Person) -> None:
    asked = {"name": "nightly", "scope": "read", "expires_in_days": 1}
    made = person.browser.post("/tokens", json=asked)
    assert made.status_code == 201
    assert made.headers["cache-control"] == "no-store"
    token = made.json()["token"]
    script = console.client(token)
    me = script.get("/auth/me").json()
    assert (me["role"], me["kind"], me["csrf_token"]) == ("viewer", "token", None)
    assert script.post("/rig/commands", json={"command": "stop"}).is_success  # no page, no CSRF
    (listed,) = person.browser.get("/tokens").json()
    assert listed["last_used_at"] is not None
    assert token not in person.browser.get("/tokens").text
    assert person.browser.delete(f"/tokens/{made.json()['id']}").status_code == 204
    assert told(script.get("/rig")) == (401, "not_signed_in")


def test_an_expired_token_is_refused(console: ConsoleProcess, person: Person) -> None:
    asked = {"name": "short", "scope": "read", "expires_in_days": 1e-9}
    token = person.browser.post("/tokens", json=asked).json()["token"]
    assert told(console.client(token).get("/rig")) == (401, "not_signed_in")


@pytest.mark.parametrize(
    "header", [b"", b"Bearer", b"Bearer x", b"Basic YTpi", b"bearer \xe4", b"x" * 8000]
)
def test_a_bad_header_is_refused(stranger: httpx2.Client, header: bytes) -> None:
    answer = stranger.get("/rig", headers={b"Authorization": header})
    assert told(answer) == (401, "not_signed_in")
    assert answer.headers["www-authenticate"] == "Bearer"


def test_nothing_is_read_of_a_body_before_it_is_known_who_sends_it(
    stranger: httpx2.Client,
) -> None:
    answer = stranger.post("/tests/import", content=b"not json", headers={"Content-Length": "8"})
    assert told(answer) == (401, "not_signed_in")
    assert told(stranger.get("/nowhere")) == (401, "not_signed_in")


# ---- the live stream ----


def hears(console: ConsoleProcess, path: str = "", **headers: str) -> bool:
    """Whether the live stream lets one in."""
    address = console.url.replace("http", "ws") + "/api/v1/live" + path
    try:
        with connect(address, additional_headers=headers) as stream:
            return "hello" in str(stream.recv(PATIENCE_S))
    except InvalidStatus as refused:
        if refused.response.status_code != 403:
            raise
        return False


def test_the_live_stream_asks_who_it_is(console: ConsoleProcess, person: Person) -> None:
    assert not hears(console)
    assert not hears(console, **bearer("wrong"))
    assert not hears(console, "?ticket=wrong")
    assert hears(console, **bearer(console.token))
    assert hears(console, **person.cookies)
    assert not hears(console, **person.cookies, **bearer(console.token))
    assert not hears(console, **person.cookies, Origin="http://evil.example")


def test_a_ticket_opens_one_live_stream(console: ConsoleProcess, person: Person) -> None:
    ticket = person.browser.post("/auth/ticket").json()["ticket"]
    assert told(console.client().get(f"/rig?ticket={ticket}")) == (401, "not_signed_in")
    assert hears(console, f"?ticket={ticket}")
    assert not hears(console, f"?ticket={ticket}")


def how_it_ends(stream: Connection) -> int | None:
    """Read until the stream is closed; the code that it is closed with."""
    while True:
        try:
            stream.recv(PATIENCE_S)
        except ConnectionClosed as closed:
            return None if closed.rcvd is None else closed.rcvd.code


def _sign_out(console: ConsoleProcess, person: Person) -> httpx2.Response:
    return person.browser.post("/auth/logout")


def _end_from_afar(console: ConsoleProcess, person: Person) -> httpx2.Response:
    mine = [one for one in person.browser.get("/sessions").json() if one["present"]]
    return console.http.delete(f"/sessions/{mine[0]['id']}")


def _disable(console: ConsoleProcess, person: Person) -> httpx2.Response:
    return console.http.patch(f"/users/{person.id}", json={"disabled": True})


def _demote(console: ConsoleProcess, person: Person) -> httpx2.Response:
    return console.http.patch(f"/users/{person.id}", json={"role": "viewer"})


def _remove(console: ConsoleProcess, person: Person) -> httpx2.Response:
    return console.http.delete(f"/users/{person.id}")


@pytest.mark.parametrize("end", [_sign_out, _end_from_afar, _disable, _demote, _remove])
def test_a_live_stream_ends_with_the_right_to_it(
    console: ConsoleProcess,
    person: Person,
    end: Callable[[ConsoleProcess, Person], httpx2.Response],
) -> None:
    address = console.url.replace("http", "ws") + "/api/v1/live"
    with connect(address, additional_headers=person.cookies) as stream:
        assert end(console, person).is_success
        assert how_it_ends(stream) == 4401


def test_a_live_stream_ends_with_its_token(console: ConsoleProcess, person: Person) -> None:
    asked = {"name": "screen", "scope": "read"}
    made = person.browser.post("/tokens", json=asked).json()
    address = console.url.replace("http", "ws") + "/api/v1/live"
    with connect(address, additional_headers=bearer(made["token"])) as stream:
        console.http.delete(f"/tokens/{made['id']}")
        assert how_it_ends(stream) == 4401
