"""What every browser is given: consecutive ticks, nothing twice, and the gap where the ring lapped."""

import json

import pytest

from app.link.life import Life
from app.live.broadcaster import MOST_TICKS, Broadcaster
from app.live.client import Client
from app.live.frame import HEADER, Stretch
from app.live.messages import Subscribe
from app.rigs.schemas import RigStatus
from rtcore.modes import Mode
from tests.written_block import WrittenBlock


class Ear(Client):
    """A client that keeps what it is given."""

    def __init__(self) -> None:
        super().__init__()
        self.given: list[tuple[int, int, int]] = []  # first tick, ticks, lost
        self.messages: list[dict[str, object]] = []
        self.subscribe(Subscribe(type="subscribe", subscription=1, channels=["force_n"]))

    def put_samples(self, stretch: Stretch, lost_ticks: int) -> None:
        super().put_samples(stretch, lost_ticks)
        while self._samples:
            _, _, _, ticks, first, lost, _ = HEADER.unpack_from(self._samples.popleft())
            self.given.append((first, ticks, lost))

    def put_message(self, text: str) -> None:
        self.messages.append(json.loads(text))

    def put_status(self, text: str) -> None:
        pass


def no_status() -> RigStatus:
    raise AssertionError("nobody asked for it")


@pytest.fixture
def loop() -> WrittenBlock:
    written = WrittenBlock()
    written.go(Mode.OFF)  # before anybody listened
    written.ticks(50)
    return written


def listening(life: Life) -> tuple[Broadcaster, Ear]:
    broadcaster, ear = Broadcaster(lambda: life, no_status), Ear()
    broadcaster._clients.add(ear)
    broadcaster.pump()
    return broadcaster, ear


def test_everybody_gets_every_tick_once(loop: WrittenBlock) -> None:
    broadcaster, ear = listening(loop.life())
    for ticks in (133, 0, 1, 200):
        loop.ticks(ticks)
        broadcaster.pump()
    assert ear.given == [(50, 133, 0), (183, 1, 0), (184, 200, 0)]


def test_a_lapped_ring_is_told(loop: WrittenBlock) -> None:
    broadcaster, ear = listening(loop.life())
    loop.ticks(10_000)
    broadcaster.pump()
    kept = len(loop.block.ring) - 1
    assert ear.given == [(50 + 10_000 - kept, MOST_TICKS, 10_000 - kept)]


def test_events_are_in_words_and_in_order(loop: WrittenBlock) -> None:
    broadcaster, ear = listening(loop.life())
    loop.trip(0, -6120.0, 6000.0)
    loop.go(Mode.STOPPING)
    loop.ticks(1)
    broadcaster.runs_changed()
    broadcaster.pump()
    texts = [message["event"]["text"] for message in ear.messages if message["type"] == "event"]  # type: ignore[index]
    assert texts == ["Force error 6,120 N for 50 ms, limit 6,000 N", "Stopping"]
    assert {"type": "runs"} in ear.messages


def test_a_new_loop_is_followed_from_its_first_tick(loop: WrittenBlock) -> None:
    lives = [loop.life()]
    broadcaster, ear = Broadcaster(lambda: lives[-1], no_status), Ear()
    broadcaster._clients.add(ear)
    broadcaster.pump()
    loop.ticks(10)
    broadcaster.pump()
    other = WrittenBlock()
    lives.append(other.life())
    broadcaster.pump()
    other.ticks(20)
    broadcaster.pump()
    assert ear.given == [(50, 10, 0), (0, 20, 0)]
