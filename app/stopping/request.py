"""The little of HTTP that Stop needs: one request, read within bounds, and one answer."""

import socket
import time
from collections.abc import Mapping
from dataclasses import dataclass
from email.message import Message
from http import HTTPStatus
from http.client import HTTPException, parse_headers
from io import BytesIO

MOST_BYTES = 16_384  # of the head of a request
MOST_BODY_BYTES = 4096  # which is read, so that closing does not lose the answer, and not looked at
WITHIN_S = 2.0  # for all of it: who is slower is sent away
_END = b"\r\n\r\n"


class NoRequest(Exception):
    """What came is not a request, or came too slowly: there is nobody to answer."""


@dataclass(frozen=True)
class Request:
    """What was asked for. `headers` are found whatever their case."""

    method: str
    path: str
    headers: Message


@dataclass(frozen=True)
class Answer:
    """What is said to it: `body` is JSON."""

    status: int
    body: bytes
    media_type: str
    headers: Mapping[str, str]

    def written(self) -> bytes:
        """As it goes over the wire."""
        lines = [
            f"HTTP/1.1 {self.status} {HTTPStatus(self.status).phrase}",
            f"Content-Type: {self.media_type}",
            f"Content-Length: {len(self.body)}",
            "Connection: close",
            "Cache-Control: no-store",
            "X-Content-Type-Options: nosniff",
            *(f"{name}: {value}" for name, value in self.headers.items()),
        ]
        return "\r\n".join(lines).encode("latin-1") + _END + self.body


def read_request(connection: socket.socket) -> Request:
    """Read one request. Raises `NoRequest`, or `OSError` where the connection is lost or too slow."""
    deadline = time.monotonic() + WITHIN_S
    head, _, begun = _read_until(connection, _END, deadline).partition(_END)
    first, _, rest = head.partition(b"\r\n")
    parts = first.decode("latin-1").split(" ")
    if len(parts) != 3 or not parts[2].startswith("HTTP/1."):
        raise NoRequest
    try:
        headers = parse_headers(BytesIO(rest + _END))
        length = int(headers.get("content-length", "0"))
    except (HTTPException, ValueError):
        raise NoRequest from None
    _read_body(connection, min(length, MOST_BODY_BYTES) - len(begun), deadline)
    return Request(parts[0], parts[1].partition("?")[0], headers)


def _read_until(connection: socket.socket, end: bytes, deadline: float) -> bytes:
    found = b""
    while end not in found:
        if len(found) > MOST_BYTES:
            raise NoRequest
        found += _read(connection, deadline)
    return found


def _read_body(connection: socket.socket, left: int, deadline: float) -> None:
    while left > 0:
        left -= len(_read(connection, deadline))


def _read(connection: socket.socket, deadline: float) -> bytes:
    connection.settimeout(max(0.001, deadline - time.monotonic()))
    read = connection.recv(4096)
    if not read or time.monotonic() > deadline:
        raise NoRequest
    return read
