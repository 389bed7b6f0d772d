"""What the routes of an application ask for, found by walking all of them."""

from collections.abc import Iterator

from fastapi import FastAPI
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute, APIWebSocketRoute
from starlette.routing import BaseRoute

from app.access.principal import Role


def routes_of(app: FastAPI) -> Iterator[BaseRoute]:
    """Every route, those of included routers and mounted applications too."""
    waiting = list(app.routes)
    while waiting:
        route = waiting.pop()
        inner = getattr(route, "original_router", route)
        within = list(getattr(inner, "routes", None) or [])
        if within:
            waiting += within
        else:
            yield route


def path_of(route: BaseRoute) -> str:
    """Where a route is; what has no path might be anywhere."""
    return str(getattr(route, "path", "/api/v1"))


def role_asked(route: BaseRoute) -> Role | None:
    """The role that a route asks for, None where it asks for none."""
    if not isinstance(route, APIRoute | APIWebSocketRoute):
        return None
    roles = list(_asked(route.dependant))
    return max(roles, default=None)


def _asked(dependant: Dependant) -> Iterator[Role]:
    role = getattr(dependant.call, "requires", None)
    if isinstance(role, Role):
        yield role
    for inner in dependant.dependencies:
        yield from _asked(inner)
