"""The telemetry ring and the event ring: one writer, index published last, readers that know what they missed."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.channels import TELEMETRY
from rtcore.compiled import (
    carray,
    kernel,
    load_acquire,
    offset_of,
    pointer,
    read_index,
    store_release,
)
from rtcore.memory.layout import BLOCK, EVENT_SLOTS, RING_OFFSET
from rtcore.memory.segment import Block

_TELEMETRY = offset_of(BLOCK, "telemetry_published")
_EVENTS = offset_of(BLOCK, "events_published")
_RECORD_BYTES = TELEMETRY.itemsize


@kernel
def next_record_address(block_address: int) -> int:
    """Where the next telemetry record is to be written."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    slot = block.telemetry_published & (block.telemetry_slots - 1)
    return block_address + RING_OFFSET + slot * _RECORD_BYTES


@kernel
def publish_record(block_address: int) -> None:
    """Make the record at `next_record_address` visible to readers."""
    store_release(block_address + _TELEMETRY, load_acquire(block_address + _TELEMETRY) + 1)


@kernel
def publish_event(
    block_address: int, tick: int, kind: int, code: int, value: float, limit: float
) -> None:
    """Append an event and make it visible."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    sequence = load_acquire(block_address + _EVENTS)
    event = block.events[sequence % EVENT_SLOTS]
    event.sequence = sequence
    event.tick = tick
    event.kind = kind
    event.code = code
    event.value = value
    event.limit = limit
    store_release(block_address + _EVENTS, sequence + 1)


@dataclass(frozen=True)
class Batch:
    """Records read in order, and how many before them were overwritten unread."""

    records: npt.NDArray[Any]
    lost: int


@dataclass
class RingReader:
    """Reads a ring from `position` on. It never disturbs the writer."""

    block: Block
    ring: npt.NDArray[Any]
    published_offset: int
    position: int = 0

    @property
    def published(self) -> int:
        """How many records have ever been written."""
        return read_index(self.block.address + self.published_offset)

    def read(self, at_most: int = 1 << 16) -> Batch:
        """The next records, copied. One slot is left alone, for the writer may be filling it."""
        slots = len(self.ring)
        published = self.published
        oldest = max(0, published - slots + 1)
        first = max(self.position, oldest)
        last = max(first, min(published, first + at_most))
        records = self.ring[np.arange(first, last) % slots]
        # What the writer reached while we copied may be torn: it is lost, and counted.
        overtaken = min(max(0, self.published - slots + 1 - first), last - first)
        lost = max(0, first - self.position) + overtaken
        self.position = last
        return Batch(records[overtaken:], lost)


def telemetry_reader(block: Block, position: int = 0) -> RingReader:
    """Reads TELEMETRY records."""
    return RingReader(block, block.ring, _TELEMETRY, position)


def event_reader(block: Block, position: int = 0) -> RingReader:
    """Reads EVENT records."""
    return RingReader(block, block.fields["events"], _EVENTS, position)
