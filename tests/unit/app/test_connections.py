"""The console's own port: who says nothing, or says it slowly, keeps nobody else from being heard."""

import asyncio
import socket
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from threading import Event, Thread
from typing import Any

import pytest
import uvicorn
from websockets.sync.client import connect

import app.connections as connections
from app.connections import BoundedProtocol

ASK = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"
PATIENCE_S = 30.0


async def answer(scope: Any, receive: Any, send: Any) -> None:
    """An application that answers everything, once all of it has come."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.accept"})
        await send({"type": "websocket.send", "text": (await receive())["text"]})
        return
    while (await receive()).get("more_body"):
        pass
    if scope["path"] == "/endless":
        return await pour(receive, send)
    await send(
        {"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]}
    )
    await send({"type": "http.response.body", "body": b"{}"})


async def pour(receive: Any, send: Any) -> None:
    """Say something until whoever asked has gone."""
    poured_out.clear()
    await send({"type": "http.response.start", "status": 200, "headers": []})
    gone = asyncio.ensure_future(receive())
    while not gone.done():
        await send({"type": "http.response.body", "body": bytes(65_536), "more_body": True})
        await asyncio.sleep(0)
    poured_out.set()


poured_out = Event()


@contextmanager
def serving() -> Iterator[int]:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        config = uvicorn.Config(answer, http=BoundedProtocol, lifespan="off", log_config=None)
        server = uvicorn.Server(config)
        thread = Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        try:
            yield int(listener.getsockname()[1])
        finally:
            server.should_exit = True
            thread.join()


@pytest.fixture
def port() -> Iterator[int]:
    with serving() as found:
        yield found


def connected(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)


def is_answered(client: socket.socket) -> bool:
    client.sendall(ASK)
    return client.recv(1000).startswith(b"HTTP/1.1 200")


def is_sent_away(client: socket.socket) -> bool:
    try:
        return client.recv(1000) == b""
    except ConnectionResetError:
        return True


@pytest.mark.parametrize(
    "said", [b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: localhost\r\nX-A: b\r\n"]
)
def test_who_is_slow_with_a_head_is_sent_away(
    port: int, said: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "HEAD_S", 0.2)
    with closing(connected(port)) as client:
        client.sendall(said)
        assert is_sent_away(client)


def test_who_is_slow_with_a_second_head_is_sent_away(
    port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Uvicorn's own limit ends with the first byte."""
    monkeypatch.setattr(connections, "HEAD_S", 0.2)
    with closing(connected(port)) as client:
        assert is_answered(client)
        client.sendall(ASK[:10])
        assert is_sent_away(client)


def test_a_body_may_take_its_time(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "HEAD_S", 0.05)
    with closing(connected(port)) as client, closing(connected(port)) as silent:
        client.sendall(b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\na")
        assert is_sent_away(silent)  # so the time is over
        client.sendall(b"b")
        assert client.recv(1000).startswith(b"HTTP/1.1 200")


def test_an_answer_that_nobody_reads_is_ended(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "STALL_S", 0.2)
    with closing(connected(port)) as client:
        client.sendall(ASK.replace(b"/ ", b"/endless "))
        assert poured_out.wait(PATIENCE_S)


def test_of_too_many_who_say_nothing_one_goes(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "MOST", 20)
    with ExitStack() as held:
        silent = [held.enter_context(closing(connected(port))) for _ in range(60)]
        for one in silent:
            one.sendall(b"G")
        for _ in range(30):
            with closing(connected(port)) as client:
                assert is_answered(client)


def test_a_live_stream_may_be_silent(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "HEAD_S", 0.2)
    with connect(f"ws://127.0.0.1:{port}") as stream, closing(connected(port)) as silent:
        assert is_sent_away(silent)
        stream.send("here still")
        assert stream.recv(PATIENCE_S) == "here still"
