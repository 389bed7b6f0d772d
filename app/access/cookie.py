"""The cookie of a session: no script reads it, and no other site's page sends it."""

from starlette.requests import Request
from starlette.responses import Response

from app.access.book import LONGEST
from app.access.door import cookie_of, is_secure


def give_cookie(request: Request, response: Response, key: str) -> None:
    """Have the browser keep the key of its session."""
    response.set_cookie(
        cookie_of(request.scope),
        key,
        max_age=int(LONGEST.total_seconds()),
        path="/",
        secure=is_secure(request.scope),
        httponly=True,
        samesite="strict",
    )


def take_cookie(request: Request, response: Response) -> None:
    """Have the browser forget it."""
    response.delete_cookie(
        cookie_of(request.scope),
        path="/",
        secure=is_secure(request.scope),
        httponly=True,
        samesite="strict",
    )
