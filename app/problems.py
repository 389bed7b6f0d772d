"""Problem documents (RFC 9457): the one table from refusal codes to HTTP statuses."""

import logging
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from fastapi import FastAPI, Request
from fastapi.encoders import jsonable_encoder
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, ConfigDict
from sqlalchemy.exc import OperationalError
from starlette.exceptions import HTTPException

from app.errors import Code, Fault, Refusal

T = TypeVar("T")
MEDIA_TYPE = "application/problem+json"
LONGEST_VALUE = 200
_SECRET = frozenset({"password", "old", "new"})

STATUS: Mapping[Code, int] = {
    Code.INVALID_REQUEST: 422,
    Code.NOT_FOUND: 404,
    Code.METHOD_NOT_ALLOWED: 405,
    Code.NOT_SIGNED_IN: 401,
    Code.NOT_ALLOWED: 403,
    Code.TWO_CREDENTIALS: 400,
    Code.CSRF: 403,
    Code.SIGN_IN_FAILED: 401,
    Code.WRONG_PASSWORD: 403,
    Code.WEAK_PASSWORD: 422,
    Code.TOO_MANY_ATTEMPTS: 429,
    Code.TOO_MANY_REQUESTS: 429,
    Code.UNKNOWN_USER: 404,
    Code.USER_EXISTS: 409,
    Code.LAST_ADMIN: 409,
    Code.OWN_ACCOUNT: 409,
    Code.UNKNOWN_TOKEN: 404,
    Code.UNKNOWN_SESSION: 404,
    Code.FOREIGN_ORIGIN: 403,
    Code.UNKNOWN_HOST: 403,
    Code.TOO_LARGE: 413,
    Code.UNKNOWN_TEST: 404,
    Code.UNKNOWN_REVISION: 404,
    Code.TEST_EXISTS: 409,
    Code.TEST_ARCHIVED: 409,
    Code.REVISION_NEEDED: 428,
    Code.EDIT_CONFLICT: 409,
    Code.INVALID_HISTORY: 422,
    Code.HISTORY_EXISTS: 409,
    Code.UNKNOWN_RUN: 404,
    Code.UNKNOWN_FIRST_OUT: 404,
    Code.UNKNOWN_DRILL: 404,
    Code.UNKNOWN_CHANNEL: 422,
    Code.INVALID_TEST: 422,
    Code.RUN_UNDER_WAY: 409,
    Code.NO_DATA: 404,
    Code.INVALID_REPORT: 409,
    Code.LOOP_LOST: 503,
    Code.LOOP_SILENT: 504,
    Code.WRONG_MODE: 409,
    Code.LEASE_NEEDED: 409,
    Code.LEASE_HELD: 409,
    Code.STALE_LEASE: 409,
    Code.EXPIRED: 504,
    Code.REPLAYED: 409,
    Code.UNKNOWN_COMMAND: 422,
    Code.CAUSE_PRESENT: 409,
    Code.INVALID_BANK: 422,
    Code.INTERLOCKS_WEAKENED: 409,
    Code.NO_PROGRAM: 409,
    Code.BUSY: 409,
    Code.BROKE_OFF: 503,
    Code.NO_SPACE: 409,
    Code.PREDICTION_REFUSED: 409,
    Code.PREDICTION_PENDING: 409,
    Code.OVERRIDE_NEEDED: 409,
    Code.DATABASE_UNAVAILABLE: 503,
    Code.INTERNAL: 500,
}


class FaultOut(BaseModel):
    """One thing that is wrong in what was sent; what is not known of it is null."""

    path: str
    value: Any = None
    expected: str
    limit: float | None = None
    unit: str | None = None
    line: int | None = None

    @staticmethod
    def of(fault: Fault) -> "FaultOut":
        """Faults of documents know limit, unit and line; others do not."""
        known = {name: getattr(fault, name, None) for name in ("limit", "unit", "line")}
        return FaultOut(path=fault.path, value=fault.value, expected=fault.expected, **known)


class Problem(BaseModel):
    """A problem document; some codes bring members of their own (`current_revision` …)."""

    model_config = ConfigDict(extra="allow")

    type: str = "about:blank"
    title: str
    status: int
    code: Code
    detail: str
    errors: list[FaultOut] = []


PROBLEMS: dict[int | str, dict[str, Any]] = {
    "default": {"model": Problem, "description": "A problem document (RFC 9457)"}
}


class Refused(Exception):
    """A refusal on its way out of a router. Only routers raise it, through `granted`."""

    def __init__(self, refusal: Refusal) -> None:
        super().__init__(refusal.detail)
        self.refusal = refusal


def granted(result: T | Refusal) -> T:
    """The result of a service call, unless it is a refusal: that becomes a problem document."""
    if isinstance(result, Refusal):
        raise Refused(result)
    return result


def title(code: Code) -> str:
    """A code as words: `wrong_mode` is "Wrong mode"."""
    return code.replace("_", " ").capitalize()


def problem(refusal: Refusal, status: int | None = None) -> JSONResponse:
    """A refusal as a response."""
    more: dict[str, Any] = dict(refusal.about)
    body = Problem(
        title=title(refusal.code),
        status=status or STATUS[refusal.code],
        code=refusal.code,
        detail=refusal.detail,
        errors=[FaultOut.of(fault) for fault in refusal.faults],
        **more,
    )
    headers = _headers(body.status, more)
    return JSONResponse(jsonable_encoder(body), body.status, headers, media_type=MEDIA_TYPE)


def _headers(status: int, about: Mapping[str, Any]) -> dict[str, str]:
    """What HTTP wants said in the head too."""
    headers = {"WWW-Authenticate": "Bearer"} if status == 401 else {}
    if "retry_after_s" in about:
        headers["Retry-After"] = str(about["retry_after_s"])
    return headers


def _path(location: tuple[int | str, ...]) -> str:
    """`("body", "blocks", 1, "kind")` as `body.blocks[1].kind`."""
    return "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in location).lstrip(".")


def _shown(value: Any) -> Any:
    """What was sent, but not pages of it."""
    if isinstance(value, float) and value - value != 0.0:
        return str(value)  # JSON has neither NaN nor infinity
    if value is None or isinstance(value, bool | int | float):
        return value
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= LONGEST_VALUE else text[:LONGEST_VALUE] + "…"


def _sent(error: Mapping[str, Any]) -> Any:
    """What was sent there. Not where something is missing, or nothing could be read: what came
    instead may hold a password."""
    place = error["loc"]
    whole = place == ("body",) and isinstance(error.get("input"), str | bytes)
    if whole or error["type"] == "missing" or place[-1] in _SECRET:
        return None
    return _shown(error.get("input"))


def invalid_request(error: RequestValidationError) -> Refusal:
    """What FastAPI found wrong in a request, as a refusal."""
    faults = tuple(Fault(_path(e["loc"]), _sent(e), e["msg"]) for e in error.errors())
    detail = "; ".join(f"{fault.path}: {fault.expected}" for fault in faults)
    return Refusal(Code.INVALID_REQUEST, detail or "The request could not be understood", faults)


def _http_code(status: int) -> Code:
    known = {404: Code.NOT_FOUND, 405: Code.METHOD_NOT_ALLOWED}
    return known.get(status, Code.INVALID_REQUEST if status < 500 else Code.INTERNAL)


def install_handlers(
    app: FastAPI, tell: Callable[[Request, Refusal], None] = lambda request, refusal: None
) -> None:
    """Answer every failure of `app` with a problem document. `tell` hears of every refusal."""

    async def refused(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, Refused)
        tell(request, error.refusal)
        return problem(error.refusal)

    async def invalid(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, RequestValidationError)
        return problem(invalid_request(error))

    async def http(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, HTTPException)
        response = problem(Refusal(_http_code(error.status_code), error.detail), error.status_code)
        response.headers.update(error.headers or {})
        return response

    async def database(request: Request, error: Exception) -> JSONResponse:
        logging.getLogger(__name__).error("database: %s", error)
        return problem(
            Refusal(
                Code.DATABASE_UNAVAILABLE, "The database does not answer: try again in a moment"
            )
        )

    async def unexpected(request: Request, error: Exception) -> JSONResponse:
        return problem(Refusal(Code.INTERNAL, "An error of the console's own: see its log"))

    app.add_exception_handler(Refused, refused)
    app.add_exception_handler(RequestValidationError, invalid)
    app.add_exception_handler(HTTPException, http)
    app.add_exception_handler(OperationalError, database)
    app.add_exception_handler(Exception, unexpected)
