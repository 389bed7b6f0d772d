"""Work in a process of its own, at a low priority: it holds up neither the console nor the loop."""

import os
import signal
from collections.abc import Callable
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from threading import Event, Thread
from typing import Any, TypeVar

NICENESS = 15
LOOK_S = 0.1  # how often it is asked whether the work is still wanted

T = TypeVar("T")
Report = Callable[[float], None]  # told the share that is done, 0…1


class WorkFailed(Exception):
    """Nothing came of the work; the text says what happened."""


class BrokeOff(WorkFailed):
    """Its process died: that is no fault of the work's, and another try may come to its end."""


class GivenUp(Exception):
    """Nobody wanted it any more."""


def run_apart(
    work: Callable[..., T], *arguments: Any, report: Report, unwanted: Event | None = None
) -> T:
    """`work(report, *arguments)`, done by another process; function, arguments and result are pickled.

    Raises `WorkFailed` where it raised, `BrokeOff` where it died, `GivenUp` once it is unwanted.
    """
    context = get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(theirs, work, arguments), daemon=True)
    process.start()
    theirs.close()
    try:
        return _outcome(ours, report, unwanted)  # type: ignore[no-any-return]  # what was pickled
    finally:
        process.kill()
        process.join()
        process.close()
        ours.close()


def _outcome(connection: Connection, report: Report, unwanted: Event | None) -> Any:
    while True:
        if unwanted is not None and unwanted.is_set():
            raise GivenUp
        if not connection.poll(LOOK_S):
            continue
        try:
            word, told = connection.recv()
        except EOFError:
            raise BrokeOff("Its process ended before it was done: try again") from None
        if word == "done":
            return told
        if word == "failed":
            raise WorkFailed(told)
        report(told)


def _work(connection: Connection, work: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    settle_down()
    try:
        found = work(lambda share: connection.send(("report", share)), *arguments)
        connection.send(("done", found))
    except Exception as error:
        connection.send(("failed", f"{type(error).__name__}: {error}"))


def settle_down() -> None:
    """Have this process give way to all others, and end with the process that started it."""
    Thread(target=_end_with_parent, name="parent", daemon=True).start()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever started it ends it
    os.setpriority(os.PRIO_PROCESS, 0, NICENESS)


def _end_with_parent() -> None:
    """The kernel's own death signal (PR_SET_PDEATHSIG) would come with the end of the starting thread."""
    parent = parent_process()
    assert parent is not None, "it was started by multiprocessing"
    wait([parent.sentinel])
    os._exit(1)
