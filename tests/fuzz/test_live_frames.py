"""The live stream, told anything by everybody while a test runs."""

import json
import re
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from app.access.principal import Role
from rtcore.channels import CHANNELS
from tests.fuzz.under_way import UnderWay

pytestmark = [pytest.mark.process, pytest.mark.slow]
PATIENCE_S = 60
TOO_LARGE, NO_TEXT, TOO_SLOW, PROTOCOL = 1009, 1007, 1013, 1002  # as docs/wire.md has them
LARGEST = 16_384
MORE_BYTES = 64e6  # that the console may take for good while all of this is sent
LAST = 2**32 - 1  # the subscription by which each example ends
SOME = settings(
    max_examples=40, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)

plain = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20)
anything = st.recursive(
    plain,
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=9), inner, max_size=4)
    ),
    max_leaves=10,
)
names = st.sampled_from([channel.name for channel in CHANNELS]) | st.text(max_size=9)
subscribing = st.fixed_dictionaries(
    {"type": st.just("subscribe")},
    optional={
        "subscription": st.integers(-1, 2**33) | anything,
        "channels": st.lists(names, max_size=40) | anything,
        "more": anything,
    },
)
beating = st.fixed_dictionaries(
    {"type": st.just("beat")},
    optional={"epoch": st.integers(-1, 2**54) | st.integers() | anything, "more": anything},
)
frames = st.one_of(
    (subscribing | beating | st.fixed_dictionaries({"type": anything}) | anything).map(json.dumps),
    st.text(max_size=200),
    st.binary(max_size=200),
    st.integers(1, 4000).map(lambda depth: "[" * depth),
    st.integers(1, 2000).map(lambda depth: '{"type":' * depth),
    st.integers(4090, LARGEST).map(lambda size: "x" * size),
    st.sampled_from(
        ['{"type":"beat","epoch":1e999}', '{"type":"subscribe","channels":["\\ud800"]}']
    ),
)


@contextmanager
def listening(run: UnderWay, headers: dict[str, str], **options: Any) -> Iterator[Connection]:
    address = run.console.url.replace("http", "ws") + "/api/v1/live"
    with connect(address, additional_headers=headers, **options) as stream:
        yield stream


def subscribe(stream: Connection, number: int, *channels: str) -> None:
    stream.send(json.dumps({"type": "subscribe", "subscription": number, "channels": channels}))


def errors_until(stream: Connection, subscription: int) -> list[dict[str, Any]]:
    """Read until samples of that subscription come; the error frames before them."""
    errors: list[dict[str, Any]] = []
    while True:
        frame = stream.recv(PATIENCE_S)
        if isinstance(frame, bytes):
            if int.from_bytes(frame[20:24], "little") == subscription:
                return errors
        elif (message := json.loads(frame))["type"] == "error":
            errors.append(message)


def code_at_the_end(stream: Connection) -> int | None:
    """Read until the stream is closed; the code that it is closed with.

    None where the connection went first: the system drops what the console has said to whoever goes
    on sending.
    """
    while True:
        try:
            stream.recv(PATIENCE_S)
        except ConnectionClosed as closed:
            return None if closed.rcvd is None else closed.rcvd.code


@pytest.fixture(autouse=True)
def memory_and_the_run_stay(under_way: UnderWay) -> Iterator[None]:
    before = memory_bytes(under_way)
    yield
    under_way.goes_on()
    assert memory_bytes(under_way) - before < MORE_BYTES
    assert "Traceback" not in under_way.console.said()


def memory_bytes(run: UnderWay) -> int:
    """What is the console's own."""
    words = Path(f"/proc/{run.console.pid}/status").read_text()
    found = re.search(r"RssAnon:\s+(\d+) kB", words)
    assert found
    return int(found.group(1)) * 1024


@pytest.fixture(scope="module", params=list(Role), ids=lambda role: role.word)
def role(request: pytest.FixtureRequest) -> Role:
    found: Role = request.param
    return found


@pytest.fixture(scope="module")
def stream(under_way: UnderWay, role: Role) -> Iterator[Connection]:
    with listening(under_way, under_way.headers(role), close_timeout=0.1) as made:
        yield made


@SOME
@example(sent=[b"\0", '{"type":"beat","epoch":0}', '{"type":"beat","epoch":9007199254740992}'])
@given(sent=st.lists(frames, min_size=1, max_size=8))
def test_whatever_is_said_is_answered_and_the_stream_goes_on(
    under_way: UnderWay, stream: Connection, sent: list[str | bytes]
) -> None:
    epoch = under_way.console.http.get("/lease").json()["epoch"]
    for frame in sent:
        stream.send(frame)
    subscribe(stream, LAST, "time_s")
    errors = errors_until(stream, LAST)
    assert len(errors) <= len(sent)
    for error in errors:
        assert set(error) == {"type", "code", "detail"}
        assert error["code"] in ("invalid_request", "stale_lease", "lease_held", "lease_needed")
        assert error["detail"]
    subscribe(stream, 0)
    assert under_way.console.http.get("/lease").json()["epoch"] == epoch


def test_a_beat_with_an_epoch_of_somebody_elses_is_refused(
    under_way: UnderWay, stream: Connection
) -> None:
    held = under_way.console.http.get("/lease").json()["epoch"]
    epochs = [held, held - 1, held + 1, 0, -1, 2**53, 2**53 + 1, 10**400, "1", None, 1.5, [1]]
    for epoch in epochs:
        stream.send(json.dumps({"type": "beat", "epoch": epoch}))
    subscribe(stream, LAST, "time_s")
    assert len(errors_until(stream, LAST)) == len(epochs)
    subscribe(stream, 0)


def test_a_flood_of_subscriptions_is_followed_to_the_last(
    under_way: UnderWay, stream: Connection
) -> None:
    every = [channel.name for channel in CHANNELS]
    for number in range(2000):
        subscribe(stream, number, *every[: number % len(every)])
    subscribe(stream, LAST, "time_s")
    assert errors_until(stream, LAST) == []
    subscribe(stream, 0)


@pytest.mark.parametrize(
    "sent",
    ["x" * (LARGEST + 1), b"x" * 1_000_000, "[" * 1_000_000, ["x" * 1000] * 100],
    ids=["text", "binary", "deep", "parts"],
)
def test_what_is_too_large_ends_the_stream(under_way: UnderWay, role: Role, sent: Any) -> None:
    with listening(under_way, under_way.headers(role)) as stream:
        with suppress(ConnectionClosed):  # which comes before the last part
            stream.send(sent)
        assert code_at_the_end(stream) in (TOO_LARGE, None)


def test_text_that_is_no_text_ends_the_stream(under_way: UnderWay, role: Role) -> None:
    with listening(under_way, under_way.headers(role)) as stream:
        stream.send(b"\xff\xfe", text=True)
        assert code_at_the_end(stream) == NO_TEXT


def test_what_is_no_frame_ends_the_stream(under_way: UnderWay, role: Role) -> None:
    with listening(under_way, under_way.headers(role)) as stream:
        stream.socket.sendall(b"\xff" * 64)
        assert code_at_the_end(stream) in (PROTOCOL, None)


def test_who_asks_without_listening_is_sent_away(under_way: UnderWay, role: Role) -> None:
    """Errors are kept for whoever asked, but not without end."""
    with listening(under_way, under_way.headers(role), max_queue=1, close_timeout=1) as stream:
        stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        with suppress(ConnectionClosed, OSError):
            for _ in range(100_000):
                stream.send("nonsense")
        assert code_at_the_end(stream) in (TOO_SLOW, None)


def is_heard(run: UnderWay, query: str, **headers: str) -> bool:
    address = run.console.url.replace("http", "ws") + "/api/v1/live" + query
    try:
        with connect(address, additional_headers=headers):
            return True
    except InvalidStatus as refused:
        if refused.response.status_code != 403:
            raise
        return False


@pytest.mark.parametrize(
    ("query", "headers"),
    [
        ("", {}),
        ("?ticket=", {}),
        ("?ticket=" + "x" * 4000, {}),
        ("?ticket=%00&ticket=%ff", {}),
        ("", {"Authorization": "Bearer " + "x" * 4000}),
        ("", {"Authorization": "Basic YTpi"}),
        ("", {"Cookie": "forcerig=1; ; =; x"}),
    ],
    ids=["nothing", "empty", "long", "two", "token", "basic", "cookie"],
)
def test_nobody_is_heard(under_way: UnderWay, query: str, headers: dict[str, str]) -> None:
    assert not is_heard(under_way, query, **headers)


@SOME
@given(ticket=st.text(st.characters(max_codepoint=255), max_size=60))
def test_nobody_guesses_a_ticket(under_way: UnderWay, ticket: str) -> None:
    assert not is_heard(under_way, "?ticket=" + quote(ticket))
