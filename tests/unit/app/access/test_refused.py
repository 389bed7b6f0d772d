"""What is refused to somebody who has come in: in the audit, unless it changes nothing anyway."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import NamedTuple

import pytest
from fastapi import FastAPI
from starlette.testclient import TestClient

from app.access.dependencies import Engineer, Operator, Viewer
from app.access.door import Door
from app.access.refused import note_refused
from app.access.schemas import TokenCreate, TokenMade
from app.access.scopes import Scope
from app.audit.entry import Act
from app.audit.record import take_notes
from app.errors import Code, Refusal
from app.problems import granted, install_handlers
from tests.unit.app.access.at_a_time import Desk

CONFLICT = Refusal(Code.EDIT_CONFLICT, "Somebody else was faster")
WRONG = Refusal(Code.INVALID_TEST, "There is no block")


class Asked(NamedTuple):
    method: str
    path: str
    status: int


class Site:
    """A console with some routes, all of which refuse, and an operator with a token."""

    def __init__(self, desk: Desk) -> None:
        made = desk.tokens.make_for(
            desk.enter("kl").id, TokenCreate(name="night", scope=Scope.OPERATE)
        )
        assert isinstance(made, TokenMade)
        app = FastAPI()
        app.add_middleware(Door)
        install_handlers(app, note_refused)
        authority = SimpleNamespace(seen=lambda who: None)
        access = SimpleNamespace(identity=desk.identity)
        app.state.console = SimpleNamespace(access=access, authority=authority)
        self._routes(app)
        self._client = TestClient(app)
        self._headers = {"Authorization": f"Bearer {made.token}"}

    def _routes(self, app: FastAPI) -> None:
        @app.put("/api/v1/interlocks")
        def change(who: Engineer) -> None: ...

        @app.get("/api/v1/audit")
        def audit(who: Engineer) -> None: ...

        @app.put("/api/v1/tests/one")
        def save(who: Operator) -> None:
            granted(CONFLICT)

        @app.get("/api/v1/tests/one")
        def show(who: Operator) -> None:
            granted(CONFLICT)

        @app.post("/api/v1/tests/check")
        def check(who: Viewer) -> None:
            granted(WRONG)

        for path in ("/api/v1/runs", "/api/v1/lease/beat", "/api/v1/rig/commands"):
            app.post(path)(save)

    def ask(self, asked: Asked, *, signed_in: bool = True) -> None:
        headers = self._headers if signed_in else {}
        answer = self._client.request(asked.method, asked.path, headers=headers)
        assert answer.status_code == asked.status, answer.text


@pytest.fixture
def noted() -> Iterator[list[Act]]:
    taken: list[Act] = []
    take_notes(taken.append)
    yield taken
    take_notes(None)


@pytest.fixture
def ask(desk: Desk) -> Callable[..., None]:
    return Site(desk).ask


@pytest.mark.parametrize(
    ("asked", "code"),
    [
        (Asked("PUT", "/api/v1/interlocks", 403), Code.NOT_ALLOWED),
        (Asked("GET", "/api/v1/audit", 403), Code.NOT_ALLOWED),
        (Asked("PUT", "/api/v1/tests/one", 409), Code.EDIT_CONFLICT),
    ],
)
def test_a_refusal_is_noted_with_who_asked_for_what(
    ask: Callable[..., None], noted: list[Act], asked: Asked, code: Code
) -> None:
    ask(asked)
    (row,) = noted
    assert (row.who, row.role) == ("kl (night)", "operator")
    assert (row.action, row.target) == ("requests.refused", f"{asked.method} {asked.path}")
    assert row.outcome == f"refused: {code}"
    assert row.why


@pytest.mark.parametrize(
    "asked",
    [
        Asked("GET", "/api/v1/tests/one", 409),
        Asked("POST", "/api/v1/tests/check", 422),
        Asked("POST", "/api/v1/runs", 409),  # the service enters it with what was to be run
        Asked("POST", "/api/v1/rig/commands", 409),
        Asked("POST", "/api/v1/lease/beat", 409),
    ],
)
def test_what_changes_nothing_or_is_entered_elsewhere_is_not(
    ask: Callable[..., None], noted: list[Act], asked: Asked
) -> None:
    ask(asked)
    assert noted == []


def test_who_has_not_come_in_leaves_no_row(ask: Callable[..., None], noted: list[Act]) -> None:
    ask(Asked("PUT", "/api/v1/interlocks", 401), signed_in=False)
    assert noted == []
