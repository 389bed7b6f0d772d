"""The shared block: rings that know what was missed, commands that are answered once."""

from pathlib import Path

import numpy as np
import pytest

from rtcore.codes import Opcode, Reply
from rtcore.memory.commands import CommandsFull, acknowledge, acknowledgement, pending, post
from rtcore.memory.layout import COMMAND_SLOTS, EVENT_SLOTS
from rtcore.memory.rings import (
    event_reader,
    next_record_address,
    publish_event,
    publish_record,
    telemetry_reader,
)
from rtcore.memory.segment import (
    Block,
    BlockError,
    attach_block,
    create_block,
    lock_single_loop,
    private_block,
    ring_slots,
)
from rtcore.memory.snapshot import read_snapshot, write_snapshot

PERIOD_NS = 250_000


@pytest.fixture
def block() -> Block:
    return private_block(PERIOD_NS, seconds=0.05)


def publish(block: Block, ticks: range) -> None:
    for tick in ticks:
        slot = (next_record_address(block.address) - block.ring.ctypes.data) // block.ring.itemsize
        block.ring[slot]["tick"] = tick
        publish_record(block.address)


def test_a_reader_sees_every_record_once_and_in_order(block: Block) -> None:
    reader = telemetry_reader(block)
    seen: list[int] = []
    for first in range(0, 900, 90):
        publish(block, range(first, first + 90))
        batch = reader.read(50)
        assert batch.lost == 0
        seen += list(batch.records["tick"])
        seen += list(reader.read().records["tick"])
    assert seen == list(range(900))


def test_a_lapped_reader_knows_how_many_it_missed(block: Block) -> None:
    slots = len(block.ring)
    reader = telemetry_reader(block)
    publish(block, range(3 * slots + 7))
    batch = reader.read()
    assert batch.lost + len(batch.records) == 3 * slots + 7
    assert list(batch.records["tick"]) == list(range(batch.lost, 3 * slots + 7))
    assert len(batch.records) >= slots - 1


def test_a_reader_ahead_of_the_writer_waits(block: Block) -> None:
    publish(block, range(7))
    reader = telemetry_reader(block, position=17)
    assert reader.read().lost == 0
    assert reader.position == 17
    publish(block, range(7, 20))
    assert list(reader.read().records["tick"]) == [17, 18, 19]


def test_events_are_kept_and_numbered(block: Block) -> None:
    reader = event_reader(block)
    for i in range(EVENT_SLOTS + 10):
        publish_event(block.address, i, 1, 2, 3.0, 4.0)
    batch = reader.read()
    assert batch.lost == 11  # ten are gone; one more slot may be being written
    assert list(batch.records["sequence"]) == list(range(11, EVENT_SLOTS + 10))


def test_a_command_is_answered_once(block: Block) -> None:
    sequence = post(block, Opcode.RESET)
    assert pending(block.address)
    assert acknowledgement(block, sequence) is None
    acknowledge(block.address, Reply.WRONG_MODE, 77)
    assert not pending(block.address)
    assert acknowledgement(block, sequence) == (Reply.WRONG_MODE, 77)


def test_a_full_command_ring_refuses(block: Block) -> None:
    for _ in range(COMMAND_SLOTS):
        post(block, Opcode.HOLD)
    with pytest.raises(CommandsFull, match="stopped or gone"):
        post(block, Opcode.HOLD)


def test_the_snapshot_is_the_record(block: Block) -> None:
    block.ring[3]["force_n"] = 1234.5
    write_snapshot(block.address, block.ring[3:].ctypes.data)
    record = read_snapshot(block)
    assert record is not None
    assert record["force_n"] == 1234.5


def test_a_snapshot_whose_writer_died_in_the_middle_is_not_believed(block: Block) -> None:
    block.fields["snapshot_sequence"] = 3
    assert read_snapshot(block) is None


def test_the_ring_holds_more_than_a_minute() -> None:
    assert ring_slots(PERIOD_NS) * PERIOD_NS > 60e9
    assert ring_slots(100_000) * 100_000 > 60e9


def test_an_attached_block_is_the_same_memory(tmp_path: Path) -> None:
    path = tmp_path / "a.block"
    created = create_block(path, PERIOD_NS, seconds=0.05)
    attached = attach_block(path)
    attached.fields["app_heartbeat_ns"] = 42
    assert created.fields["app_heartbeat_ns"] == 42
    assert len(attached.ring) == len(created.ring)
    assert attached.period_s == PERIOD_NS * 1e-9


def test_a_block_that_is_replaced_stays_readable_for_those_who_have_it(tmp_path: Path) -> None:
    path = tmp_path / "a.block"
    create_block(path, PERIOD_NS, seconds=0.05)
    old = attach_block(path)
    old.fields["loop_pid"] = 1
    create_block(path, PERIOD_NS, seconds=0.05)
    assert old.fields["loop_pid"] == 1
    assert attach_block(path).fields["loop_pid"] == 0
    assert [p.name for p in tmp_path.iterdir()] == ["a.block"]


@pytest.mark.parametrize(
    ("field", "message"),
    [("magic", "does not begin as a block"), ("layout_hash", "another version of forcerig")],
)
def test_a_foreign_block_is_refused(tmp_path: Path, field: str, message: str) -> None:
    path = tmp_path / "a.block"
    create_block(path, PERIOD_NS, seconds=0.05).fields[field] = 1
    with pytest.raises(BlockError, match=message):
        attach_block(path)


def test_a_missing_and_a_short_block_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.block"
    with pytest.raises(BlockError, match="not running"):
        attach_block(path)
    path.write_bytes(b"short")
    with pytest.raises(BlockError, match="5 bytes"):
        attach_block(path)


def test_there_is_one_loop(tmp_path: Path) -> None:
    path = tmp_path / "a.block"
    with lock_single_loop(path), pytest.raises(BlockError, match="already runs"):
        lock_single_loop(path)
    lock_single_loop(path).close()


def test_records_are_whole_words() -> None:
    """The snapshot copies 64-bit words: a torn word would be a torn number."""
    assert np.dtype(private_block(PERIOD_NS, 0.05).ring.dtype).itemsize % 8 == 0
