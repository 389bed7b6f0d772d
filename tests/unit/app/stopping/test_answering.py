"""Who may stop the rig on the path of its own, and what becomes of everybody else."""

import json
import socket
from collections.abc import Iterator
from email.message import Message
from types import SimpleNamespace
from typing import Any

import pytest

from app.access.keys import digest
from app.access.principal import Principal
from app.errors import Code, Refusal
from app.rigs.schemas import ModeWord
from app.stopping.answering import Answering
from app.stopping.door import StopDoor
from app.stopping.request import Answer, Request
from app.stopping.schemas import StopState

HOST = "rig.example"
OWN = f"http://{HOST}:8000"
SESSION = {"cookie": "forcerig-8000=key"}
TOKEN = {"authorization": "Bearer key"}


class Book:
    """Knows one key, as that of a viewer's session and of their token."""

    user = SimpleNamespace(id=1, name="Vi", role="viewer")

    def session(self, kept: str) -> Any:
        return SimpleNamespace(id=1, user=self.user) if kept == digest("key") else None

    def token(self, kept: str) -> Any:
        found = SimpleNamespace(id=2, user=self.user, name="script", scope="read")
        return found if kept == digest("key") else None


class Stops:
    """Counts who stopped the rig."""

    def __init__(self) -> None:
        self.by: list[str] = []
        self.answer: StopState | Refusal = StopState(mode=ModeWord.STOPPING, tick=7)

    def stop(self, who: Principal) -> StopState | Refusal:
        self.by.append(who.id)
        return self.answer

    def state(self) -> StopState | Refusal:
        return self.answer


@pytest.fixture
def stops() -> Stops:
    return Stops()


@pytest.fixture
def answering(stops: Stops) -> Iterator[Answering]:
    with socket.socket() as listener:
        door, book = StopDoor(listener, console_port=8000), Book()
        yield Answering(door, {HOST}, book, stops)  # type: ignore[arg-type]


def asked(method: str = "POST", path: str = "/stop", **headers: str) -> Request:
    message = Message()
    for name, value in {"host": f"{HOST}:8001", **headers}.items():
        message[name.replace("_", "-")] = value
    return Request(method, path, message)


def code(answer: Answer) -> tuple[int, str]:
    assert answer.media_type == "application/problem+json"
    return answer.status, json.loads(answer.body)["code"]


@pytest.mark.parametrize(("brought", "who"), [(SESSION, "session:1"), (TOKEN, "token:2")])
def test_whoever_sees_the_rig_stops_it(
    answering: Answering, stops: Stops, brought: dict[str, str], who: str
) -> None:
    answer = answering(asked(**brought))
    assert (answer.status, json.loads(answer.body)) == (200, {"mode": "stopping", "tick": 7})
    assert stops.by == [who]


@pytest.mark.parametrize(
    "brought",
    [
        {},
        {"authorization": "Bearer other"},
        {"authorization": "Basic key"},
        {"cookie": "forcerig-8000=other"},
        {"cookie": "forcerig-8001=key"},
        {"cookie": "\x00;;=,"},
    ],
)
def test_who_has_not_signed_in_does_not(
    answering: Answering, stops: Stops, brought: dict[str, str]
) -> None:
    assert code(answering(asked(**brought))) == (401, "not_signed_in")
    assert code(answering(asked("GET", **brought))) == (401, "not_signed_in")
    assert stops.by == []


def test_two_credentials_are_one_too_many(answering: Answering, stops: Stops) -> None:
    assert code(answering(asked(**SESSION, **TOKEN))) == (400, "two_credentials")
    assert stops.by == []


def test_the_consoles_own_page_may_ask_and_read(answering: Answering, stops: Stops) -> None:
    answer = answering(asked(**SESSION, origin=OWN, sec_fetch_site="same-site"))
    assert answer.status == 200
    assert answer.headers["Access-Control-Allow-Origin"] == OWN
    assert answer.headers["Access-Control-Allow-Credentials"] == "true"


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": f"https://{HOST}:8000"},
        {"origin": f"http://{HOST}:9000"},
        {"origin": f"http://{HOST}:8001"},
        {"origin": "null"},
        {"sec_fetch_site": "cross-site"},
    ],
)
def test_no_other_page_may(answering: Answering, stops: Stops, headers: dict[str, str]) -> None:
    answer = answering(asked(**SESSION, **headers))
    assert code(answer) == (403, "foreign_origin")
    assert "Access-Control-Allow-Origin" not in answer.headers
    assert stops.by == []


@pytest.mark.parametrize("host", ["evil.example:8001", "", "[::1"])
def test_another_name_is_not_known(answering: Answering, stops: Stops, host: str) -> None:
    assert code(answering(asked(**SESSION, host=host))) == (403, "unknown_host")
    assert stops.by == []


def test_there_is_nothing_else_here(answering: Answering, stops: Stops) -> None:
    assert code(answering(asked("GET", "/api/v1/rig", **SESSION))) == (404, "not_found")
    assert code(answering(asked("PUT", **SESSION))) == (405, "method_not_allowed")
    assert answering(asked("GET", **SESSION)).status == 200
    assert stops.by == []


def test_a_loop_that_does_not_confirm_is_told(answering: Answering, stops: Stops) -> None:
    stops.answer = Refusal(Code.LOOP_SILENT, "Use the emergency stop")
    assert code(answering(asked(**SESSION))) == (504, "loop_silent")
