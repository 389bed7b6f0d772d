"""What commands print: one JSON document or text on standard output, everything else beside it."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import IntEnum
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from app.documents.refusal import Problem
from app.errors import Refusal


class Exit(IntEnum):
    """How a command ends."""

    PASSED = 0
    FAILED = 1  # an acceptance criterion
    BAD_INPUT = 2
    TRIPPED = 3


def print_json(document: Any) -> None:
    """The one document of a command with `--json`."""
    print(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False))


def text_console() -> Console:
    """For what a command was asked for."""
    return Console(highlight=False, soft_wrap=True)


def side_console() -> Console:
    """For everything else."""
    return Console(stderr=True, highlight=False, soft_wrap=True)


def print_refusal(refusal: Refusal, as_json: bool) -> Exit:
    """Say why a command was refused: in its JSON document too, where that was asked for."""
    side_console().print(refusal.detail, markup=False)
    if as_json:
        errors = [fault.as_data() for fault in refusal.faults if isinstance(fault, Problem)]
        print_json({"code": refusal.code.value, "detail": refusal.detail, "errors": errors})
    return Exit.BAD_INPUT


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[float], None]]:
    """A bar with the time left, on a terminal; the function it gives is told the share done."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
    )
    shown = sys.stderr.isatty()
    with Progress(*columns, console=side_console(), transient=True, disable=not shown) as progress:
        task = progress.add_task(what, total=1.0)
        yield lambda share: progress.update(task, completed=share)
