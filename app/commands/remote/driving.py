"""What an operator does with a console, step by step: take command, predict, pressurise, start, wait, stop."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from app.commands.remote.asking import Asking
from app.errors import Code, Refusal

Progress = Callable[[float], None]
LOOK_S = 0.5
COMPUTE_S = 10.0  # how long the console is to wait with its answer
PRESSURE_S = 120.0
MEASURED_S = 60.0
TTL_S = 60.0  # how long command is kept where this program says nothing any more
_UNDER_WAY = ("running", "holding", "stopping")


@contextmanager
def command_of(console: Asking, reason: str) -> Iterator[int | Refusal]:
    """The epoch of a lease that is this program's, given up at the end. Nobody's is taken over."""
    lease = console.post("lease", {"reason": reason, "ttl_s": TTL_S})
    if isinstance(lease, Refusal):
        yield lease
        return
    try:
        yield int(lease["epoch"])
    finally:
        console.ask("DELETE", "lease")


def predicted(
    console: Asking, test_id: str, revision: int | None, progress: Progress
) -> dict[str, Any] | Refusal:
    """The prediction of a test with the console's present settings."""
    body = {"wait_s": COMPUTE_S} | ({} if revision is None else {"revision": revision})
    while True:
        answer = console.post(f"tests/{test_id}/prediction", body)
        if isinstance(answer, Refusal):
            return answer
        if answer.get("state") != "computing":
            found: dict[str, Any] = answer
            return found
        progress(answer["share"])


def made_ready(console: Asking, epoch: int, *, pressurise: bool) -> Refusal | None:
    """Have the rig ready for a test: reset and pressurised where that is wanted, and refused where not."""
    status = console.get("rig")
    if isinstance(status, Refusal) or status["mode"] == "ready":
        return status if isinstance(status, Refusal) else None
    if status["mode"] in _UNDER_WAY:
        return Refusal(Code.WRONG_MODE, "Cannot start: a test is under way")
    if not pressurise:
        detail = f"Cannot start: the rig is {status['mode']}; give --pressurise, or make it ready"
        return Refusal(Code.WRONG_MODE, detail)
    if status["mode"] == "tripped":
        refused = give(console, "reset", epoch)
        if refused is not None:
            return refused
    refused = give(console, "pressurise", epoch)
    return refused or _until_ready(console)


def give(console: Asking, command: str, epoch: int) -> Refusal | None:
    """Give a command."""
    answer = console.post("rig/commands", {"command": command, "lease": epoch})
    return answer if isinstance(answer, Refusal) else None


def _until_ready(console: Asking) -> Refusal | None:
    give_up = time.monotonic() + PRESSURE_S
    while time.monotonic() < give_up:
        status = console.get("rig")
        if isinstance(status, Refusal) or status["mode"] == "ready":
            return status if isinstance(status, Refusal) else None
        if status["mode"] not in ("pressurising", "off"):
            why = status["trips"][0]["text"] if status["trips"] else status["mode"]
            return Refusal(Code.WRONG_MODE, f"The rig did not come to pressure: {why}")
        time.sleep(LOOK_S)
    return Refusal(Code.WRONG_MODE, f"The rig has no pressure after {PRESSURE_S:.0f} s")


def ended(console: Asking, run_id: int, progress: Progress) -> dict[str, Any] | Refusal:
    """A run once it is over; of the one under way, how far it is."""
    while True:
        run = console.get(f"runs/{run_id}")
        if isinstance(run, Refusal):
            return run
        if run["outcome"] is not None:
            found: dict[str, Any] = run
            return found
        status = console.get("rig")
        under = None if isinstance(status, Refusal) else status["run"]
        if under and under["id"] == run_id and under["duration_s"]:
            progress(min(1.0, under["elapsed_s"] / under["duration_s"]))
        time.sleep(LOOK_S)


def measured(console: Asking, run_id: int) -> dict[str, Any] | Refusal:
    """What a run that is over amounts to: it is measured a moment after its end."""
    give_up = time.monotonic() + MEASURED_S
    while True:
        found = console.get(f"runs/{run_id}/measurements")
        if isinstance(found, Refusal):
            return found
        if found["run"] or time.monotonic() > give_up:
            measurements: dict[str, Any] = found
            return measurements
        time.sleep(LOOK_S)


def stopped(console: Asking, epoch: int) -> Refusal | None:
    """Take the load off, and wait until it is. Stop is for everybody: it goes through without command too."""
    refused = give(console, "stop", epoch)
    if refused is not None:
        refused = refused if console.post("rig/commands", {"command": "stop"}) else None
    give_up = time.monotonic() + PRESSURE_S
    while refused is None and time.monotonic() < give_up:
        status = console.get("rig")
        if isinstance(status, Refusal) or status["mode"] not in _UNDER_WAY:
            return status if isinstance(status, Refusal) else None
        time.sleep(LOOK_S)
    return refused
