"""The live stream of a real console: what docs/wire.md promises."""

import json
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from app.rigs.schemas import RigStatus
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
PATIENCE_S = 30
HEADER = struct.Struct("<BBHIqII")


@contextmanager
def listening(console: ConsoleProcess, **options: Any) -> Iterator[Connection]:
    address = console.url.replace("http", "ws") + "/api/v1/live"
    with connect(address, additional_headers=console.headers, **options) as stream:
        yield stream


def subscribe(stream: Connection, number: int, *channels: str) -> None:
    message = {"type": "subscribe", "subscription": number, "channels": channels}
    stream.send(json.dumps(message))


def frames(stream: Connection) -> Iterator[tuple[dict[str, int], Any]]:
    """The binary frames, for ever: the header's fields and (channels, samples) float32."""
    names = ("version", "kind", "channels", "samples", "tick", "lost", "subscription")
    while True:
        frame = stream.recv(PATIENCE_S)
        if isinstance(frame, bytes):
            fields = dict(zip(names, HEADER.unpack_from(frame), strict=True))
            shape = (fields["channels"], fields["samples"])
            yield fields, np.frombuffer(frame, "<f4", offset=HEADER.size).reshape(shape)


def read_on(stream: Connection) -> None:
    """Read until the stream ends."""
    while True:
        stream.recv(PATIENCE_S)


def messages(stream: Connection, kind: str) -> Iterator[dict[str, Any]]:
    """The JSON frames of a type, for ever."""
    while True:
        frame = stream.recv(PATIENCE_S)
        if isinstance(frame, str) and (message := json.loads(frame))["type"] == kind:
            yield message


def test_hello_comes_first_and_status_follows(console: ConsoleProcess) -> None:
    with listening(console) as stream:
        hello = json.loads(stream.recv(PATIENCE_S))
        assert (hello["type"], hello["period_s"]) == ("hello", 250e-6)
        assert {"name", "unit", "dtype", "doc"} == set(hello["channels"][0])
        status = next(messages(stream, "status"))["status"]
        assert RigStatus.model_validate(status).loop.alive
        assert stream.protocol.extensions == []  # no compression


def test_every_tick_comes_once_and_in_order(console: ConsoleProcess) -> None:
    with listening(console) as stream:
        subscribe(stream, 5, "time_s", "supply_pressure_pa")
        stretch = [frame for frame, _ in zip(frames(stream), range(40), strict=False)]
    expected = stretch[0][0]["tick"]
    for fields, samples in stretch:
        assert (fields["version"], fields["kind"], fields["subscription"]) == (1, 1, 5)
        assert (fields["tick"], fields["lost"]) == (expected, 0)
        ticks = expected + np.arange(fields["samples"])
        assert samples[0] == pytest.approx(ticks * 250e-6, rel=1e-6)
        assert (samples[1] > 0).all()
        expected += fields["samples"]
    assert expected - stretch[0][0]["tick"] > 1000


def test_a_subscription_replaces_the_one_before(console: ConsoleProcess) -> None:
    with listening(console) as stream:
        subscribe(stream, 1, "force_n")
        next(frames(stream))
        subscribe(stream, 2, "force_n", "mode", "valve_command")
        found = next(fields for fields, _ in frames(stream) if fields["subscription"] == 2)
        assert found["channels"] == 3


@pytest.mark.parametrize(
    ("sent", "complaint"),
    [
        ("nonsense", "JSON"),
        ('{"type": "subscribe", "subscription": 1, "channels": ["nothing"]}', "nothing"),
        (b"\x00", "text frames"),
    ],
)
def test_what_is_not_understood_is_answered_and_the_stream_goes_on(
    console: ConsoleProcess, sent: str | bytes, complaint: str
) -> None:
    with listening(console) as stream:
        stream.send(sent)
        error = next(messages(stream, "error"))
        assert error["code"] == "invalid_request"
        assert complaint in error["detail"]
        subscribe(stream, 1, "force_n")
        next(frames(stream))


def test_an_oversized_frame_ends_the_stream(console: ConsoleProcess) -> None:
    with listening(console) as stream:
        stream.send("x" * 1_000_000)
        with pytest.raises(ConnectionClosed) as closed:
            read_on(stream)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1009


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://localhost:1"])
def test_a_foreign_page_hears_nothing(console: ConsoleProcess, origin: str) -> None:
    with pytest.raises(InvalidStatus) as refused, listening(console, origin=origin):
        pass
    assert refused.value.response.status_code == 403


def test_the_consoles_own_page_hears(console: ConsoleProcess) -> None:
    with listening(console, origin=console.url) as stream:
        assert json.loads(stream.recv(PATIENCE_S))["type"] == "hello"


def test_events_and_the_changed_list_of_runs_arrive(ready: ConsoleProcess) -> None:
    with listening(ready) as stream:
        run_id = ready.start_run("step-2-kn")
        ready.command("stop")
        ready.ended_run(run_id)
        seen: list[str] = []
        while not ("runs" in seen and "Running" in seen and "Ready" in after(seen, "Running")):
            frame = stream.recv(PATIENCE_S)
            message = json.loads(frame) if isinstance(frame, str) else {}
            if message.get("type") == "event":
                assert set(message["event"]) == {"tick", "time_s", "kind", "code", "text"}
                seen.append(message["event"]["text"])
            elif message.get("type") == "runs":
                seen.append("runs")
        assert after(seen, "Running").index("Stopping") < after(seen, "Running").index("Ready")


def after(seen: list[str], text: str) -> list[str]:
    """What came after a message."""
    return seen[seen.index(text) :]


def test_a_browser_that_stalls_holds_up_nobody(console: ConsoleProcess) -> None:
    with listening(console, max_queue=1, close_timeout=0.1) as stalled, listening(console) as other:
        subscribe(stalled, 1, "force_n", "mode", "time_s", "pressure_1_pa")
        subscribe(other, 1, "time_s")
        total = 0
        for fields, _ in frames(other):
            assert fields["lost"] == 0
            total += fields["samples"]
            if total > 8000:
                break


def test_many_browsers_come_and_go(console: ConsoleProcess) -> None:
    for _ in range(20):
        with listening(console) as stream:
            subscribe(stream, 1, "force_n")
            next(frames(stream))
    assert wait_for(lambda: console.status()["loop"]["alive"], "the loop", 1.0)
