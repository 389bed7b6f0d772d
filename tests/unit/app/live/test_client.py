"""What a slow browser loses, and what it never loses."""

import asyncio
import json

import numpy as np
import numpy.typing as npt
import pytest

from app.errors import Refusal
from app.live.client import MOST_FRAMES, MOST_MESSAGES, Client, TooSlow
from app.live.frame import HEADER, Stretch
from app.live.messages import Subscribe, parse
from rtcore.channels import TELEMETRY

TICKS = 100


class Browser:
    """Keeps what it is sent."""

    def __init__(self) -> None:
        self.texts: list[str] = []
        self.frames: list[bytes] = []

    async def send_text(self, data: str) -> None:
        self.texts.append(data)

    async def send_bytes(self, data: bytes) -> None:
        self.frames.append(data)


def records(first: int) -> npt.NDArray[np.void]:
    made = np.zeros(TICKS, TELEMETRY)
    made["tick"] = np.arange(first, first + TICKS)
    made["force_n"] = made["tick"]
    return made


def subscribed(*channels: str) -> Client:
    client = Client()
    client.subscribe(
        Subscribe(type="subscribe", subscription=3, channels=list(channels or ("force_n",)))
    )
    return client


async def delivered(client: Client, browser: Browser) -> None:
    """Let the browser read until there is nothing more."""
    await client.send_waiting(browser)


def test_a_frame_is_as_the_wire_has_it() -> None:
    client, browser = subscribed("force_n", "velocity_m_s"), Browser()
    client.put_samples(Stretch(records(500)), 7)
    asyncio.run(delivered(client, browser))
    (frame,) = browser.frames
    assert HEADER.unpack_from(frame) == (1, 1, 2, TICKS, 500, 7, 3)
    samples = np.frombuffer(frame, "<f4", offset=HEADER.size).reshape(2, TICKS)
    assert np.array_equal(samples[0], np.arange(500, 500 + TICKS))
    assert not samples[1].any()
    assert HEADER.size == 24


def test_a_slow_browser_loses_whole_frames_and_is_told_how_many_ticks() -> None:
    client, browser = subscribed(), Browser()
    for i in range(MOST_FRAMES + 5):
        client.put_samples(Stretch(records(i * TICKS)), 0)
    asyncio.run(delivered(client, browser))
    assert len(browser.frames) == MOST_FRAMES
    client.put_samples(Stretch(records(1_000_000)), 11)
    asyncio.run(delivered(client, browser))
    lost = [HEADER.unpack_from(frame)[5] for frame in browser.frames]
    assert lost == [0] * MOST_FRAMES + [5 * TICKS + 11]


def test_a_slow_browser_loses_no_event_and_sees_the_newest_status() -> None:
    client, browser = subscribed(), Browser()
    for i in range(MOST_MESSAGES):
        client.put_status(f"status {i}")
        client.put_message(f"event {i}")
    asyncio.run(delivered(client, browser))
    assert browser.texts == [*(f"event {i}" for i in range(MOST_MESSAGES)), "status 999"]


def test_who_leaves_too_many_events_unread_is_sent_away() -> None:
    client, browser = subscribed(), Browser()
    for _ in range(MOST_MESSAGES + 1):
        client.put_message("event")
    with pytest.raises(TooSlow):
        asyncio.run(client.send(browser))


def test_a_new_subscription_is_not_given_what_waited_for_the_old_one() -> None:
    client, browser = subscribed(), Browser()
    client.put_samples(Stretch(records(0)), 0)
    client.subscribe(Subscribe(type="subscribe", subscription=4, channels=["mode"]))
    client.put_samples(Stretch(records(TICKS)), 0)
    asyncio.run(delivered(client, browser))
    assert [HEADER.unpack_from(frame)[4:] for frame in browser.frames] == [(TICKS, 0, 4)]


@pytest.mark.parametrize(
    ("frame", "complaint"),
    [
        (None, "text frames"),
        ("{", "JSON"),
        ('{"type": "subscribe"}', "subscription"),
        ('{"type": "shout", "subscription": 1, "channels": []}', "type"),
        ('{"type": "subscribe", "subscription": -1, "channels": []}', "subscription"),
        ('{"type": "subscribe", "subscription": 1, "channels": ["force"]}', "force"),
        ('{"type": "subscribe", "subscription": 1, "channels": ["mode", "mode"]}', "twice"),
        (json.dumps({"type": "subscribe", "subscription": 1, "channels": ["x" * 9000]}), "4096"),
    ],
)
def test_a_frame_that_is_not_understood_is_refused_with_a_reason(
    frame: str | None, complaint: str
) -> None:
    refusal = parse(frame)
    assert isinstance(refusal, Refusal)
    assert complaint in refusal.detail
