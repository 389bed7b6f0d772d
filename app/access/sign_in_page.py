"""`GET /sign-in?token=…`: the link that lets somebody in once."""

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse, RedirectResponse, Response

from app.access.cookie import give_cookie
from app.access.dependencies import AccessService

router = APIRouter()
_NOT_GOOD = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>forcerig: sign in</title>
<h1>This link is no longer good</h1>
<p>A link signs in once, within a day, and only the newest one does. Somebody may have used it already.</p>
<ul>
<li>With a name and a password: <a href="/">sign in</a>.</li>
<li>Without one: an admin makes a new link under System, Users; or on the console's machine
<code>forcerig user link NAME</code> prints one.</li>
<li>As long as no admin has a password, the console prints a link each time it starts.</li>
</ul>
"""


@router.get("/sign-in", include_in_schema=False)
def sign_in_by_link(
    request: Request, access: AccessService, token: Annotated[str, Query(max_length=200)] = ""
) -> Response:
    """Sign in by a link, and go to the console."""
    key = access.sessions.by_link(token) if token else None
    if key is None:
        return HTMLResponse(_NOT_GOOD, status_code=403)
    response = RedirectResponse("/", status_code=303)
    give_cookie(request, response, key)
    return response
