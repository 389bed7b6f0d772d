"""What a request brings to show who asks: the cookie of a session, a bearer token, or a ticket."""

from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import parse_qs

from app.access.refusals import NOT_SIGNED_IN, TWO_CREDENTIALS
from app.errors import Refusal

_BEARER = "bearer "


@dataclass(frozen=True)
class Credentials:
    """What was brought; None for what was not."""

    session: str | None = None
    token: str | None = None
    ticket: str | None = None
    csrf: str | None = None


def cookie_name(port: int, *, secure: bool) -> str:
    """Browsers know cookies by host, not by port: two consoles of a machine are told apart here."""
    return f"__Host-forcerig-{port}" if secure else f"forcerig-{port}"


def credentials_in(
    headers: Mapping[str, str], cookies: Mapping[str, str], query: bytes, cookie: str
) -> Credentials | Refusal:
    """What a request brings. Refused where it is a token and something else: whose request is it?"""
    authorization = headers.get("authorization")
    session = cookies.get(cookie)
    ticket = next(iter(parse_qs(query.decode("latin-1")).get("ticket", [])), None)
    if authorization is None:
        return Credentials(session, None, ticket, headers.get("x-csrf-token"))
    if session is not None or ticket is not None:
        return TWO_CREDENTIALS
    if not authorization.lower().startswith(_BEARER):
        return NOT_SIGNED_IN
    return Credentials(token=authorization[len(_BEARER) :].strip())
