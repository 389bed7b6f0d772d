"""Work for the tests, importable by another process."""

import os
from pathlib import Path
from time import sleep
from typing import BinaryIO

from app.jobs.apart import Report, run_apart
from app.jobs.stream import PIECE_BYTES


def squares(report: Report, count: int) -> list[int]:
    """The squares, reported one by one."""
    found = []
    for i in range(count):
        found.append(i * i)
        report((i + 1) / count)
    return found


def priority(report: Report) -> int:
    """The niceness of whoever does this."""
    return os.getpriority(os.PRIO_PROCESS, 0)


def wrong(report: Report) -> None:
    """Never works."""
    raise ValueError("no such orifice")


def dies(report: Report) -> None:
    """Its process is gone at once."""
    os._exit(3)


def endless(report: Report, began: Path) -> None:
    """Says its process number, and never ends."""
    began.write_text(str(os.getpid()))
    while True:
        sleep(0.01)


def trickle(out: BinaryIO, pieces: int) -> None:
    """So many pieces, as slowly as somebody reads them."""
    for _ in range(pieces):
        out.write(bytes(PIECE_BYTES))
        sleep(0.05)


def await_ending(began: Path) -> None:
    """Start endless work, as a console does, and wait for it."""
    run_apart(endless, began, report=lambda _: None)
