"""The port for Stop: what is slow, strange or too much keeps nobody from being heard."""

import socket
from collections.abc import Iterator
from contextlib import closing
from threading import Event
from threading import enumerate as enumerate_threads

import pytest

from app.stopping.door import StopDoor
from app.stopping.listening import MOST, StopListener
from app.stopping.request import MOST_BYTES, Answer, Request

ASK = b"POST /stop?now HTTP/1.1\r\nHost: localhost\r\nX-Word: please\r\n\r\n"
PATIENCE_S = 30.0


class Asked:
    """Answers everything, and keeps what was asked."""

    def __init__(self) -> None:
        self.requests: list[Request] = []
        self.fails = False
        self.go_on = Event()
        self.go_on.set()

    def __call__(self, request: Request) -> Answer:
        self.requests.append(request)
        self.go_on.wait(PATIENCE_S)
        if self.fails:
            raise ValueError
        return Answer(200, b"{}", "application/json", {"Vary": "Origin"})


@pytest.fixture
def asked() -> Asked:
    return Asked()


@pytest.fixture
def port(asked: Asked) -> Iterator[int]:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        running = StopListener(StopDoor(listener, console_port=1), asked)
        running.start()
        yield int(listener.getsockname()[1])
        running.close()


def connected(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)


def said(connection: socket.socket) -> bytes:
    """Everything until it hangs up."""
    found = b""
    try:
        while read := connection.recv(65536):
            found += read
    except ConnectionResetError:
        pass
    return found


def test_a_request_is_answered_once_and_the_connection_closed(port: int, asked: Asked) -> None:
    with closing(connected(port)) as client:
        client.sendall(ASK)
        head, _, body = said(client).partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 200 OK\r\n")
    assert b"Content-Length: 2" in head
    assert b"Vary: Origin" in head
    assert body == b"{}"
    (request,) = asked.requests
    assert (request.method, request.path) == ("POST", "/stop")
    assert request.headers["x-word"] == "please"


def test_a_request_may_come_in_pieces_and_with_a_body(port: int, asked: Asked) -> None:
    with closing(connected(port)) as client:
        for byte in ASK.replace(b"X-Word: please", b"Content-Length: 3"):
            client.sendall(bytes([byte]))
        client.sendall(b"abc")
        assert said(client).startswith(b"HTTP/1.1 200")


@pytest.mark.parametrize(
    "sent",
    [
        b"\r\n\r\n",
        b"stop\r\n\r\n",
        b"\x16\x03\x01\x02\x00\r\n\r\n",
        b"POST /stop HTTP/1.1\r\nContent-Length: many\r\n\r\n",
        b"POST /stop HTTP/1.1\r\n" + b"X: y\r\n" * 200 + b"\r\n",
        b"POST /" + b"x" * (MOST_BYTES + 1),
    ],
)
def test_what_is_no_request_is_not_answered_and_harms_nobody(
    port: int, asked: Asked, sent: bytes
) -> None:
    with closing(connected(port)) as client:
        client.sendall(sent)
        assert said(client) == b""
    assert asked.requests == []
    with closing(connected(port)) as client:
        client.sendall(ASK)
        assert said(client).startswith(b"HTTP/1.1 200")


def test_who_opens_and_says_nothing_keeps_nobody_out(port: int) -> None:
    silent = [connected(port) for _ in range(3 * MOST)]
    try:
        with closing(connected(port)) as client:
            client.sendall(ASK)
            assert said(client).startswith(b"HTTP/1.1 200")
        assert said(silent[0]) == b""  # the oldest was sent away
        assert sum(thread.name == "stop" for thread in enumerate_threads()) <= MOST + 2
    finally:
        for one in silent:
            one.close()


def test_who_is_slow_is_sent_away(port: int, asked: Asked) -> None:
    with closing(connected(port)) as client:
        client.sendall(ASK[:10])
        assert said(client) == b""
    assert asked.requests == []


def test_one_that_is_not_answered_yet_holds_up_no_other(port: int, asked: Asked) -> None:
    asked.go_on.clear()
    with closing(connected(port)) as first, closing(connected(port)) as second:
        first.sendall(ASK)
        second.sendall(ASK)
        while len(asked.requests) < 2:
            asked.go_on.wait(0.01)
        asked.go_on.set()
        assert said(first).startswith(b"HTTP/1.1 200")
        assert said(second).startswith(b"HTTP/1.1 200")


def test_an_error_of_ours_ends_no_listening(port: int, asked: Asked) -> None:
    asked.fails = True
    with closing(connected(port)) as client:
        client.sendall(ASK)
        assert said(client) == b""
    asked.fails = False
    with closing(connected(port)) as client:
        client.sendall(ASK)
        assert said(client).startswith(b"HTTP/1.1 200")
