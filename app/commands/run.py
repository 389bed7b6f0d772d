"""`forcerig run`: a test on the rig of a running console, from command to verdict."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.commands.output import Exit, print_json, print_refusal, progress_bar, side_console
from app.commands.remote.asking import Asking
from app.commands.remote.driving import (
    command_of,
    ended,
    made_ready,
    measured,
    predicted,
    stopped,
)
from app.commands.remote.junit import COMPLETED, junit
from app.errors import Code, Refusal


@dataclass(frozen=True)
class Request:
    """What was asked for on the command line."""

    test_id: str
    url: str
    token: str
    reason: str
    revision: int | None = None
    pressurise: bool = False
    wait: bool = False
    report: Path | None = None
    junit: Path | None = None
    as_json: bool = False

    @property
    def waits(self) -> bool:
        """What is written of a run is written after its end."""
        return self.wait or self.report is not None or self.junit is not None


def run(request: Request) -> Exit:
    """Drive it, and print what came of it."""
    unwritable = _why_not_written(request)
    if unwritable is not None:
        return print_refusal(unwritable, request.as_json)
    with Asking(request.url, request.token, _say) as console, _interrupted_by_signals():
        status = console.reached()
        if isinstance(status, Refusal):
            return print_refusal(status, request.as_json)
        return _in_command(console, request)


def _in_command(console: Asking, request: Request) -> Exit:
    with command_of(console, request.reason) as epoch:
        if isinstance(epoch, Refusal):
            return print_refusal(epoch, request.as_json)
        try:
            run_id = _started(console, request, epoch)
            if isinstance(run_id, Refusal):
                return print_refusal(run_id, request.as_json)
            _say(f"Run {run_id} has begun")
            if not request.waits:
                if request.as_json:
                    print_json({"run": run_id})
                return Exit.PASSED
            with progress_bar(f"Run {run_id}") as progress:
                found = ended(console, run_id, progress)
        except KeyboardInterrupt:
            return _given_up(console, epoch)
        return _told(console, request, run_id, found)


def _started(console: Asking, request: Request, epoch: int) -> int | Refusal:
    """The number of the run."""
    with progress_bar("Predicting") as progress:
        prediction = predicted(console, request.test_id, request.revision, progress)
    if isinstance(prediction, Refusal):
        return prediction
    reasons = "; ".join(reason["text"] for reason in prediction["reasons"])
    if prediction["verdict"] == "refused":
        return Refusal(Code.PREDICTION_REFUSED, f"The prediction refuses the test: {reasons}")
    _say(f"Prediction: {prediction['verdict']}{f', {reasons}' if reasons else ''}")
    unready = made_ready(console, epoch, pressurise=request.pressurise)
    if unready is not None:
        return unready
    body = {"test_id": request.test_id, "lease": epoch, "notes": request.reason}
    more = {} if request.revision is None else {"revision": request.revision}
    begun = console.post("runs", body | more)
    return begun if isinstance(begun, Refusal) else int(begun["id"])


def _told(console: Asking, request: Request, run_id: int, found: dict[str, Any] | Refusal) -> Exit:
    result = found if isinstance(found, Refusal) else measured(console, run_id)
    if isinstance(found, Refusal) or isinstance(result, Refusal):
        refusal = found if isinstance(found, Refusal) else result
        assert isinstance(refusal, Refusal)
        _say(f"What became of run {run_id} is not known here: it may still go on")
        return print_refusal(refusal, request.as_json)
    unwritten = _written(console, request, found, result)
    if request.as_json:
        print_json({"run": found, "measurements": result})
    else:
        _print_verdict(found, result)
    if unwritten is not None:
        side_console().print(unwritten.detail, markup=False)
        return Exit.BAD_INPUT
    return exit_code(found, result)


def exit_code(run_told: dict[str, Any], result: dict[str, Any]) -> Exit:
    """As of `simulate`: 3 where it did not come to its end, 1 where a criterion is not met."""
    if run_told["outcome"] != COMPLETED:
        return Exit.TRIPPED
    met = all(criterion["outcome"] == "pass" for criterion in result["criteria"])
    return Exit.PASSED if met else Exit.FAILED


def _written(
    console: Asking, request: Request, run_told: dict[str, Any], result: dict[str, Any]
) -> Refusal | None:
    try:
        if request.junit is not None:
            request.junit.write_bytes(junit(run_told, result["criteria"]))
        if request.report is not None:
            ending = request.report.suffix.removeprefix(".").lower()
            content = console.file(f"runs/{run_told['id']}/report.{ending}")
            if isinstance(content, Refusal):
                return content
            request.report.write_bytes(content)
    except OSError as error:
        return Refusal(Code.INVALID_REQUEST, f"Cannot write {error.filename}: {error.strerror}")
    return None


def _why_not_written(request: Request) -> Refusal | None:
    """Known before anything moves."""
    for path in (request.report, request.junit):
        if path is not None and not path.absolute().parent.is_dir():
            return Refusal(Code.INVALID_REQUEST, f"There is no folder {path.parent}")
    if request.report is not None and request.report.suffix.lower() not in (".pdf", ".html"):
        return Refusal(Code.INVALID_REQUEST, "--report: its name ends in .pdf or .html")
    return None


def _given_up(console: Asking, epoch: int) -> Exit:
    """Interrupted: where nothing runs yet, there is nothing to stop."""
    _say("Stopping: the load comes off")
    refusal = stopped(console, epoch)
    if refusal is None:
        _say("Stopped")
    else:
        _say(f"The test may still go on. {refusal.detail}. Press Stop at the rig")
    return Exit.TRIPPED


def _print_verdict(run_told: dict[str, Any], result: dict[str, Any]) -> None:
    print(f"Run {run_told['id']}: {run_told['outcome']}, {result['verdict']}")
    if run_told["reason"]:
        print(run_told["reason"])
    for criterion in result["criteria"]:
        value = criterion["value"]
        shown = "not measured" if value is None else f"{value:g} {criterion['unit']}"
        print(f"  {criterion['outcome']:5} {criterion['measurement']}: {shown}")


def _say(text: str) -> None:
    side_console().print(text, markup=False)


@contextmanager
def _interrupted_by_signals() -> Iterator[None]:
    """Whoever ends this program, with Ctrl C or without: the load comes off first.

    A shell has what runs in its background ignore Ctrl C: here it does not.
    """
    signals = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, signal.default_int_handler) for number in signals]
    try:
        yield
    finally:
        for number, handler in zip(signals, before, strict=True):
            signal.signal(number, handler)
