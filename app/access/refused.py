"""What was refused to somebody who has come in, for the audit: one place for every route."""

from starlette.requests import Request

from app.access.door import SAFE, principal_of
from app.access.principal import Role
from app.audit.record import Entry, note
from app.errors import Code, Refusal

ROLE_ASKED = "role_asked"  # in the state of a request: what its route asks for
# Who gives commands, starts runs or gives drills enters what is refused there; signs of a holder
# are too many, and change nothing.
_ENTERED = frozenset({"/api/v1/rig/commands"})
_ENTERED_BUT_FOR_ROLES = frozenset({"/api/v1/runs", "/api/v1/drills", "/api/v1/lease/beat"})
_ALWAYS = (Code.NOT_ALLOWED, Code.WRONG_PASSWORD)


def note_refused(request: Request, refusal: Refusal) -> None:
    """Note what was refused, where it would have changed something, or was not theirs to ask."""
    if principal_of(request.scope) is not None and _is_told(request, refusal):
        asked = f"{request.method} {request.scope['path']}"
        note(Entry("requests.refused", asked, refusal.detail, refused=refusal.code))


def _is_told(request: Request, refusal: Refusal) -> bool:
    path = request.scope["path"]
    if path in _ENTERED:
        return False
    if refusal.code in _ALWAYS:
        return True
    # What a viewer may ask with a body computes, and is refused at every other key that is typed.
    role: Role = getattr(request.state, ROLE_ASKED, Role.VIEWER)
    changes = request.method not in SAFE and role > Role.VIEWER
    return changes and path not in _ENTERED_BUT_FOR_ROLES
