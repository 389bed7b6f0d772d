"""Every route asks for a right: who adds one without is told by name."""

from fastapi import APIRouter, FastAPI
from fastapi.routing import APIRoute

from app.access.dependencies import Operator
from app.access.door import SIGN_IN
from app.access.principal import Principal, Role, lacking
from app.errors import Refusal
from app.main import create_app
from app.settings import Settings
from tests.rights import path_of, role_asked, routes_of


def unguarded(app: FastAPI) -> list[str]:
    """The paths under /api that ask for no right."""
    under = [route for route in routes_of(app) if path_of(route).startswith("/api")]
    return [path_of(route) for route in under if role_asked(route) is None]


def test_every_route_asks_for_a_right() -> None:
    app = create_app(Settings())
    assert len(list(routes_of(app))) > 60
    assert unguarded(app) == [SIGN_IN]


def test_a_route_that_forgets_to_ask_is_found() -> None:
    app, inner = FastAPI(), APIRouter(prefix="/api/v1/lamps")

    @inner.get("")
    def lamps() -> None: ...

    @inner.post("")
    def light(who: Operator) -> None: ...

    outer = APIRouter()
    outer.include_router(inner)
    app.include_router(outer)
    assert unguarded(app) == ["/api/v1/lamps"]
    (asking,) = [r for r in routes_of(app) if isinstance(r, APIRoute) and r.methods == {"POST"}]
    assert role_asked(asking) is Role.OPERATOR


def test_each_role_includes_those_before_it_and_a_refusal_names_the_role() -> None:
    for held in Role:
        who = Principal("session:1", "KL", held, "session", 1)
        for needed in Role:
            refusal = lacking(who, needed)
            assert (refusal is None) == (held >= needed)
            if isinstance(refusal, Refusal):
                assert needed.word in refusal.detail
                assert held.word in refusal.detail
