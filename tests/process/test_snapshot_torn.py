"""The snapshot under a writer that never pauses: no torn record is ever accepted."""

import os
from collections.abc import Iterator
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from rtcore.channels import TELEMETRY
from rtcore.compiled import address_of, carray, entry, kernel, pointer
from rtcore.memory.segment import Block, attach_block, create_block
from rtcore.memory.snapshot import read_snapshot_into, write_snapshot

pytestmark = [pytest.mark.process, pytest.mark.slow]

READS = 10_000_000
WORDS = TELEMETRY.itemsize // 8


@kernel
def write_many(block_address: int, record_address: int, first: int, count: int) -> None:
    """Write records of which every word is the same number, `first` and up."""
    record = carray(pointer(record_address), WORDS, np.int64)
    for number in range(first, first + count):
        for i in range(WORDS):
            record[i] = number
        write_snapshot(block_address, record_address)


@kernel
def is_whole(record_address: int) -> bool:
    """Whether every word is the same number."""
    record = carray(pointer(record_address), WORDS, np.int64)
    different = 0
    for i in range(1, WORDS):
        different += record[i] != record[0]
    return different == 0


@entry
def read_many(block_address: int, record_address: int, tally_address: int, count: int) -> None:
    """Read so often, and count what came out: (refused or accepted) by (whole or torn)."""
    tally = carray(pointer(tally_address), (2, 2), np.int64)
    for _ in range(count):
        accepted = read_snapshot_into(block_address, record_address)
        whole = is_whole(record_address)
        tally[1 if accepted else 0, 1 if whole else 0] += 1


def write_until_killed(path: Path) -> None:
    block = attach_block(path)
    record = np.zeros(1, TELEMETRY)
    number = 1
    while True:
        write_many(block.address, address_of(record), number, 100_000)
        number += 100_000


class Outcome(NamedTuple):
    refused_torn: int
    refused_whole: int
    accepted_torn: int
    accepted_whole: int


@pytest.fixture
def block(tmp_path: Path) -> Iterator[Block]:
    """A shared block with a process that writes its snapshot flat out."""
    path = tmp_path / "block"
    block = create_block(path, 250_000, seconds=0.1)
    writer = get_context("spawn").Process(target=write_until_killed, args=(path,), daemon=True)
    writer.start()
    snapshot: Any = block.fields["snapshot"]
    while snapshot["tick"] == 0:  # the writer compiles first
        assert writer.is_alive()
        writer.join(0.01)
    yield block
    assert writer.is_alive(), "the writer must have written all the time"
    writer.kill()
    writer.join()


def test_no_torn_record_is_accepted_in_ten_million_reads(block: Block) -> None:
    record = np.zeros(1, TELEMETRY)
    tally = np.zeros((2, 2), np.int64)
    read_many(block.address, address_of(record), address_of(tally), READS)
    outcome = Outcome(*tally.ravel().tolist())
    print(f"\n{READS:,} reads: {outcome}")  # a figure of the project: shown with pytest -s
    assert sum(outcome) == READS
    assert outcome.accepted_torn == 0
    assert outcome.accepted_whole > 0
    if len(os.sched_getaffinity(0)) > 1:  # or else reader and writer take turns
        assert outcome.refused_torn > 0, "nothing was torn: this test has tested nothing"
