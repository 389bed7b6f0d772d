"""The shared block as a memory-mapped file: create it, attach to it, hold the single-loop lock.

A plain `mmap` of a file, because an attaching process of multiprocessing.shared_memory unlinks the
segment when it exits (Python 3.11).
"""

import fcntl
import mmap
import os
import tempfile
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from rtcore.channels import TELEMETRY
from rtcore.compiled import address_of
from rtcore.memory.layout import BLOCK, LAYOUT_HASH, MAGIC, RING_OFFSET, block_bytes

RING_SECONDS = 65


class BlockError(Exception):
    """The shared block cannot be used; the message says why and what to do."""


class Block:
    """A view of one shared block. `fields` is the record of the layout, `ring` the telemetry."""

    def __init__(self, buffer: Any, telemetry_slots: int) -> None:
        self._raw: npt.NDArray[np.uint8] = np.frombuffer(buffer, dtype=np.uint8)
        self.fields: Any = self._raw[: BLOCK.itemsize].view(BLOCK)[0]
        end = RING_OFFSET + telemetry_slots * TELEMETRY.itemsize
        self.ring: npt.NDArray[Any] = self._raw[RING_OFFSET:end].view(TELEMETRY)
        self.address = address_of(self._raw)

    @property
    def period_s(self) -> float:
        return float(self.fields["period_ns"]) * 1e-9


def ring_slots(period_ns: int, seconds: float = RING_SECONDS) -> int:
    """Records of a ring that holds at least so many seconds: a power of two."""
    return 1 << max(8, int(np.ceil(np.log2(seconds * 1e9 / period_ns))))


def _initialise(block: Block, period_ns: int) -> None:
    fields = block.fields
    fields["layout_hash"] = LAYOUT_HASH
    fields["telemetry_slots"] = len(block.ring)
    fields["period_ns"] = period_ns
    fields["first_out"] = -1
    fields["magic"] = MAGIC


def private_block(period_ns: int, seconds: float = RING_SECONDS) -> Block:
    """A block of ordinary memory, for the virtual clock: the same layout, shared with nobody."""
    slots = ring_slots(period_ns, seconds)
    block = Block(mmap.mmap(-1, block_bytes(slots)), slots)
    _initialise(block, period_ns)
    return block


def create_block(path: Path, period_ns: int, seconds: float = RING_SECONDS) -> Block:
    """A fresh shared block at `path`, complete before it appears there.

    Whoever still has the block of an earlier loop mapped keeps it, and can read it to its end.
    """
    slots = ring_slots(period_ns, seconds)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        os.posix_fallocate(handle, 0, block_bytes(slots))
        block = Block(mmap.mmap(handle, block_bytes(slots)), slots)
        _initialise(block, period_ns)
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    finally:
        os.close(handle)
    return block


def attach_block(path: Path) -> Block:
    """The block at `path`. Raises `BlockError` where it is missing, foreign or of another layout."""
    try:
        with path.open("r+b") as file:
            size = os.fstat(file.fileno()).st_size
            if size < BLOCK.itemsize:
                raise BlockError(
                    f"{path.name} has {size} bytes, {BLOCK.itemsize} needed: not a block of forcerig"
                )
            buffer = mmap.mmap(file.fileno(), size)
    except FileNotFoundError:
        raise BlockError(
            f"no shared block at {path.name}: the loop process is not running"
        ) from None
    header = np.frombuffer(buffer, dtype=BLOCK, count=1)[0]
    if header["magic"] != MAGIC:
        raise BlockError(f"{path.name} does not begin as a block of forcerig")
    if header["layout_hash"] != LAYOUT_HASH:
        raise BlockError(
            f"{path.name} was laid out by another version of forcerig "
            f"({int(header['layout_hash']):x}, this one is {LAYOUT_HASH:x}): stop that version first"
        )
    return Block(buffer, int(header["telemetry_slots"]))


def lock_single_loop(path: Path) -> IO[bytes]:
    """Hold the lock of the one loop for as long as the returned file is open.

    Raises `BlockError` where another loop holds it. The lock dies with its process.
    """
    file = path.with_suffix(".lock").open("ab+")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        file.close()
        raise BlockError(f"another loop already runs on {path.name}") from None
    return file


def loop_is_running(path: Path) -> bool:
    """Whether a loop holds the lock of this block."""
    try:
        lock_single_loop(path).close()
    except BlockError:
        return True
    return False
