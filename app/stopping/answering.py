"""Who may stop the rig on the path of its own, and what they are answered.

The console's pages ask across ports, by a request so simple that no browser asks leave before it. It
cannot bear the token of the page: the cookie that no other site's page sends and the origin stand for it.
"""

from collections.abc import Collection, Mapping
from http.cookies import CookieError, SimpleCookie
from urllib.parse import urlsplit

from app.access.book import Book, of_session, of_token
from app.access.credentials import cookie_name, credentials_in
from app.access.keys import digest
from app.access.principal import Principal
from app.access.refusals import NOT_SIGNED_IN
from app.errors import Code, Refusal
from app.problems import problem
from app.security import is_known_host
from app.stopping.door import StopDoor
from app.stopping.request import Answer, Request
from app.stopping.service import Stops

PATH = "/stop"
_NEAR = ("none", "same-origin", "same-site")  # another port is another origin of the same site
_FOREIGN = Refusal(Code.FOREIGN_ORIGIN, "Only the console's own pages may do this")


class Answering:
    """Answers requests to one door. It looks who asks up in memory, and waits for the loop only."""

    def __init__(self, door: StopDoor, hosts: Collection[str], book: Book, stops: Stops) -> None:
        self._hosts = hosts
        self._book = book
        self._stops = stops
        self._scheme = "http" if door.tls is None else "https"
        self._port = door.console_port
        self._cookie = cookie_name(door.console_port, secure=door.tls is not None)

    def __call__(self, request: Request) -> Answer:
        """The answer to a request, which for POST is given once the rig is stopping."""
        refusal = self._why_not_heard(request)
        if refusal is not None:
            return _refused(refusal)
        return self._with_leave_to_read(request, self._answer(request))

    def _answer(self, request: Request) -> Answer:
        if request.path != PATH:
            return _refused(Refusal(Code.NOT_FOUND, f"Here is nothing but {PATH}"))
        if request.method not in ("GET", "POST"):
            detail = f"GET {PATH} says how the rig is, POST {PATH} stops it"
            return _refused(Refusal(Code.METHOD_NOT_ALLOWED, detail), {"Allow": "GET, POST"})
        who = self._who(request)
        if isinstance(who, Refusal):
            return _refused(who)
        done = self._stops.stop(who) if request.method == "POST" else self._stops.state()
        if isinstance(done, Refusal):
            return _refused(done)
        return Answer(200, done.model_dump_json().encode(), "application/json", {})

    def _why_not_heard(self, request: Request) -> Refusal | None:
        """As `app.security` refuses, but that the origin is the console's: the same host, another port."""
        host, origin = request.headers.get("host", ""), request.headers.get("origin")
        if not _is_known(host, self._hosts):
            return Refusal(Code.UNKNOWN_HOST, "This console is not known by that name")
        foreign = origin is not None and origin.lower() != self._own_origin(host)
        near = request.headers.get("sec-fetch-site", "none") in _NEAR
        return _FOREIGN if foreign or not near else None

    def _own_origin(self, host: str) -> str:
        name = urlsplit(f"//{host}").hostname or ""
        usual = 443 if self._scheme == "https" else 80
        port = "" if self._port == usual else f":{self._port}"
        return f"{self._scheme}://{f'[{name}]' if ':' in name else name}{port}"

    def _who(self, request: Request) -> Principal | Refusal:
        headers = {name.lower(): value for name, value in request.headers.items()}
        brought = credentials_in(headers, _cookies(headers), b"", self._cookie)
        if isinstance(brought, Refusal):
            return brought
        if brought.token is not None:
            token = self._book.token(digest(brought.token))
            return NOT_SIGNED_IN if token is None else of_token(token)
        session = None if brought.session is None else self._book.session(digest(brought.session))
        return NOT_SIGNED_IN if session is None else of_session(session)

    def _with_leave_to_read(self, request: Request, answer: Answer) -> Answer:
        """Let the console's own page read it: a page of any other origin has been refused."""
        origin = request.headers.get("origin")
        if origin is None:
            return answer
        leave = {
            "Access-Control-Allow-Origin": origin,
            "Access-Control-Allow-Credentials": "true",
            "Vary": "Origin",
        }
        return Answer(answer.status, answer.body, answer.media_type, {**answer.headers, **leave})


def _cookies(headers: Mapping[str, str]) -> dict[str, str]:
    try:
        return {name: one.value for name, one in SimpleCookie(headers.get("cookie", "")).items()}
    except CookieError:
        return {}


def _refused(refusal: Refusal, headers: Mapping[str, str] | None = None) -> Answer:
    response = problem(refusal)
    return Answer(
        response.status_code, bytes(response.body), response.media_type or "", headers or {}
    )


def _is_known(host: str, hosts: Collection[str]) -> bool:
    try:
        return is_known_host(host, hosts)
    except ValueError:
        return False
