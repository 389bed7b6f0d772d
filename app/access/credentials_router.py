"""`/api/v1/tokens` and `/api/v1/sessions`: one's own, and everybody's for an admin."""

from fastapi import APIRouter

from app.access.dependencies import AccessService, Viewer
from app.access.schemas import SessionOut, TokenCreate, TokenMade, TokenOut
from app.parameters import Number
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1", tags=["access"], responses=PROBLEMS)


@router.get("/tokens", operation_id="listTokens")
def list_tokens(who: Viewer, access: AccessService) -> list[TokenOut]:
    """The tokens, the newest first."""
    return access.tokens.of(who)


@router.post("/tokens", status_code=201, operation_id="makeToken")
def make_token(who: Viewer, body: TokenCreate, access: AccessService) -> TokenMade:
    """A new token of one's own, up to one's own role. It is shown this once."""
    return granted(access.tokens.make(who, body))


@router.delete("/tokens/{token_id}", status_code=204, operation_id="revokeToken")
def revoke_token(who: Viewer, token_id: Number, access: AccessService) -> None:
    """End a token: what uses it is refused from now on, and its live streams end."""
    granted(access.tokens.revoke(token_id, who))


@router.get("/sessions", operation_id="listSessions")
def list_sessions(who: Viewer, access: AccessService) -> list[SessionOut]:
    """The browsers that are signed in, the newest first."""
    return access.sessions.of(who)


@router.delete("/sessions/{session_id}", status_code=204, operation_id="endSession")
def end_session(who: Viewer, session_id: Number, access: AccessService) -> None:
    """Sign a browser out from afar."""
    granted(access.sessions.end(session_id, who))
