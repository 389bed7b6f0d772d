"""`/api/v1/auth`: in, out, and who one is."""

from fastapi import APIRouter, Request, Response

from app.access.cookie import give_cookie, take_cookie
from app.access.dependencies import AccessService, Viewer
from app.access.schemas import Me, PasswordChange, SignIn, Ticket
from app.access.tickets import LIFE_S
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/auth", tags=["access"], responses=PROBLEMS)


def address_of(request: Request) -> str:
    """Where a request comes from."""
    return "" if request.client is None else request.client.host


@router.post("/login", status_code=204, operation_id="signIn")
async def sign_in(
    body: SignIn, request: Request, response: Response, access: AccessService
) -> None:
    """Sign in. The cookie holds for seven days, or until it was not used for twelve hours."""
    key = granted(await access.signing_in.sign_in(body, address_of(request)))
    give_cookie(request, response, key)


@router.post("/logout", status_code=204, operation_id="signOut")
async def sign_out(
    who: Viewer, request: Request, response: Response, access: AccessService
) -> None:
    """Sign out: the session ends, and with it its live streams."""
    granted(await access.signing_in.sign_out(who))
    take_cookie(request, response)


@router.get("/me", operation_id="getMe")
async def get_me(who: Viewer, access: AccessService) -> Me:
    """Who asks, what they may do, and what goes with their changes as X-CSRF-Token."""
    return granted(access.signing_in.me(who))


@router.post("/password", status_code=204, operation_id="setPassword")
async def set_password(
    who: Viewer, body: PasswordChange, request: Request, access: AccessService
) -> None:
    """Set one's own password. One's other sessions end."""
    granted(await access.signing_in.set_password(who, body, address_of(request)))


@router.post("/ticket", operation_id="getTicket")
async def get_ticket(who: Viewer, access: AccessService) -> Ticket:
    """A ticket for a WebSocket, where neither cookie nor header can be sent with it."""
    return Ticket(ticket=access.tickets.give(who), expires_in_s=LIFE_S)
