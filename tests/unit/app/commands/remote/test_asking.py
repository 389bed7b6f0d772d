"""A console that refuses, goes away for a while, or was never there."""

from collections.abc import Callable

import httpx2
import pytest

from app.commands.remote import asking
from app.commands.remote.asking import Asking
from app.errors import Code, Refusal

Handler = Callable[[httpx2.Request], httpx2.Response]


@pytest.fixture(autouse=True)
def _at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "AGAIN_S", 0.0)


def console(handler: Handler, told: list[str] | None = None) -> Asking:
    said = [] if told is None else told
    return Asking("http://rig:8000/", "secret", said.append, httpx2.MockTransport(handler))


def test_it_asks_under_the_interface_with_the_token() -> None:
    def handler(request: httpx2.Request) -> httpx2.Response:
        assert request.url == "http://rig:8000/api/v1/rig"
        assert request.headers["authorization"] == "Bearer secret"
        return httpx2.Response(200, json={"mode": "ready"})

    assert console(handler).reached() == {"mode": "ready"}


def test_a_refusal_comes_as_one() -> None:
    problem = {"code": "lease_held", "detail": "Ada is in command"}
    asked = console(lambda request: httpx2.Response(409, json=problem))
    assert asked.post("lease", {}) == Refusal(Code.LEASE_HELD, "Ada is in command")


def test_what_something_on_the_way_says_is_told_too() -> None:
    refusal = console(lambda request: httpx2.Response(502, text="<html>")).get("rig")
    assert isinstance(refusal, Refusal)
    assert "502" in refusal.detail


def test_a_console_that_is_not_there_is_not_waited_for() -> None:
    def handler(request: httpx2.Request) -> httpx2.Response:
        raise httpx2.ConnectError("refused")

    refusal = console(handler).reached()
    assert isinstance(refusal, Refusal)
    assert refusal.detail == "No console answers at http://rig:8000: refused"


def flaky(fails: int) -> tuple[Handler, list[str]]:
    asked: list[str] = []

    def handler(request: httpx2.Request) -> httpx2.Response:
        asked.append(request.method)
        if 1 < len(asked) <= 1 + fails:
            raise httpx2.ReadError("broken off")
        return httpx2.Response(200, json={"mode": "ready"})

    return handler, asked


def test_one_that_was_there_is_waited_for_and_that_is_said_once() -> None:
    handler, asked = flaky(3)
    told: list[str] = []
    reached = console(handler, told)
    reached.reached()
    assert reached.get("rig") == {"mode": "ready"}
    assert len(asked) == 5
    assert len(told) == 1


def test_what_changes_something_is_never_asked_twice() -> None:
    handler, asked = flaky(1)
    reached = console(handler)
    reached.reached()
    assert isinstance(reached.post("runs", {}), Refusal)
    assert asked == ["GET", "POST"]
