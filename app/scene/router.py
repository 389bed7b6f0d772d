"""`/scene/`: viser's page and its socket; `/api/v1/scene`: what it does, and what a view shows.

Host, origin and credentials have been checked before (`app.security`, `app.access.door`).
"""

import contextlib
from typing import Annotated

from fastapi import APIRouter, Path, Response, WebSocket
from fastapi.responses import HTMLResponse

from app.access.dependencies import AccessService, Viewer
from app.access.door import NOT_IN
from app.access.principal import Principal
from app.access.service import Access
from app.access.sockets import until_sent_away
from app.dependencies import SceneService
from app.errors import Refusal
from app.problems import PROBLEMS, granted, problem
from app.scene.page import scene_page
from app.scene.relay import relay
from app.scene.schemas import VIEW_NAME, SceneCursor, SceneOut
from app.scene.service import Scene

router = APIRouter()
Name = Annotated[str, Path(pattern=VIEW_NAME)]
SERVICE_RESTART = 1012
UNAVAILABLE = 503


@router.get("/api/v1/scene", operation_id="getScene", tags=["scene"], responses=PROBLEMS)
async def get_scene(who: Viewer, scene: SceneService) -> SceneOut:
    """What the 3-D view is doing, and its colours."""
    return scene.shown()


@router.post("/api/v1/scene/cursor", operation_id="pointScene", tags=["scene"], responses=PROBLEMS)
async def point_scene(who: Viewer, cursor: SceneCursor, scene: SceneService) -> SceneOut:
    """Have a view of one's own (`/scene/{view}/`) show a moment of a run, or the rig now."""
    return granted(await scene.point(who.id, cursor))


@router.get("/scene/", include_in_schema=False)
def page(who: Viewer) -> Response:
    """The page of the view that has no name."""
    return _page()


@router.get("/scene/{view}/", include_in_schema=False)
def page_of_view(who: Viewer, view: Name) -> Response:
    """The page of a view: it asks for its socket at its own address, without the slash."""
    return _page()


def _page() -> Response:
    found = scene_page()
    headers = {
        "Content-Security-Policy": found.policy,
        "X-Frame-Options": "SAMEORIGIN",
        "Cache-Control": "no-cache",
    }
    return HTMLResponse(found.html, headers=headers)


@router.websocket("/scene")
async def look(who: Viewer, socket: WebSocket, scene: SceneService, access: AccessService) -> None:
    """The socket of the view that has no name."""
    await _look(who, socket, scene, access, "")


@router.websocket("/scene/{view}")
async def look_at_view(
    who: Viewer, socket: WebSocket, scene: SceneService, access: AccessService, view: Name
) -> None:
    """The socket of a view."""
    await _look(who, socket, scene, access, view)


async def _look(who: Principal, socket: WebSocket, scene: Scene, access: Access, view: str) -> None:
    """Until either side or the right to it ends."""
    async with scene.looking(who.id, view, socket.scope["subprotocols"]) as found:
        if isinstance(found, Refusal):
            await socket.send_denial_response(problem(found, UNAVAILABLE))
            return
        async with found:
            await socket.accept(found.subprotocol)
            if await relay(socket, found, until_sent_away(who, access.book)):
                await socket.close(NOT_IN, "signed out")
                return
            with contextlib.suppress(RuntimeError):  # it may be the browser that has gone
                await socket.close(SERVICE_RESTART, "the 3-D view has ended")
