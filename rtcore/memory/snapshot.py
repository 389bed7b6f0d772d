"""The latest telemetry record, under a sequence lock: the writer never waits, a reader tries again."""

from typing import Any

import numpy as np

from rtcore.channels import TELEMETRY
from rtcore.compiled import (
    address_of,
    carray,
    fence,
    kernel,
    load_acquire,
    offset_of,
    pointer,
    store_release,
)
from rtcore.memory.layout import BLOCK
from rtcore.memory.segment import Block

_SEQUENCE = offset_of(BLOCK, "snapshot_sequence")
_RECORD = offset_of(BLOCK, "snapshot")
_WORDS = TELEMETRY.itemsize // 8
ATTEMPTS = 1000


@kernel
def write_snapshot(block_address: int, record_address: int) -> None:
    """Copy a telemetry record into the snapshot; its sequence is odd meanwhile."""
    sequence = load_acquire(block_address + _SEQUENCE)
    store_release(block_address + _SEQUENCE, sequence + 1)
    fence()
    source = carray(pointer(record_address), _WORDS, np.int64)
    target = carray(pointer(block_address + _RECORD), _WORDS, np.int64)
    for i in range(_WORDS):
        target[i] = source[i]
    store_release(block_address + _SEQUENCE, sequence + 2)


@kernel
def read_snapshot_into(block_address: int, record_address: int) -> bool:
    """One attempt to copy the snapshot out; False where the writer was at it."""
    before = load_acquire(block_address + _SEQUENCE)
    source = carray(pointer(block_address + _RECORD), _WORDS, np.int64)
    target = carray(pointer(record_address), _WORDS, np.int64)
    for i in range(_WORDS):
        target[i] = source[i]
    fence()
    return before % 2 == 0 and load_acquire(block_address + _SEQUENCE) == before


def read_snapshot(block: Block) -> Any | None:
    """The latest record as a TELEMETRY scalar, or None where the writer died in the middle of one."""
    record = np.zeros(1, TELEMETRY)
    address = address_of(record)
    for _ in range(ATTEMPTS):
        if read_snapshot_into(block.address, address):
            return record[0]
    return None
