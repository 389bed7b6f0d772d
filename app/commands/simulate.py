"""`forcerig simulate`: a test on the virtual rig, its measurements and its verdict."""

from dataclasses import dataclass
from pathlib import Path

from app.analysis.acceptance import Verdict
from app.commands.output import (
    Exit,
    print_json,
    print_refusal,
    progress_bar,
    side_console,
)
from app.commands.reported import FORMATS, reporting
from app.commands.simulated import print_measured, print_prediction
from app.commands.which_test import find_definition
from app.controller.record import load_controller
from app.controller.settings import ControllerSettings
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.prediction.account import account, metadata
from app.prediction.rig import load_rig_file
from app.prediction.setup import Setup
from app.prediction.simulation import Simulating, begin_simulation
from app.prediction.through import Through
from app.recording.columns import as_batch
from app.recording.outcome import Outcome
from app.recording.parquet import write_run
from rtcore.rig.parameters import load_rig


@dataclass(frozen=True)
class Request:
    """What was asked for on the command line."""

    test: str
    rig: Path | None = None
    controller: Path | None = None
    seed: int = 1
    out: Path | None = None
    report: Path | None = None
    as_json: bool = False


def run(request: Request) -> Exit:
    """Simulate, write the file, print what came of it."""
    setup = _setup(request)
    if isinstance(setup, Refusal):
        return print_refusal(setup, request.as_json)
    with progress_bar("Simulating") as progress:
        simulating = begin_simulation(setup, progress)
        if isinstance(simulating, Refusal):
            return print_refusal(simulating, request.as_json)
        with reporting(request.test, request.out, request.report) as wanted:
            unwritten = _run_through(simulating, wanted.recorded) or wanted.write(simulating)
    if unwritten is not None:
        return print_refusal(unwritten, request.as_json)
    if request.out is not None:
        ticks = simulating.through.ticks
        side_console().print(f"Wrote {ticks:,} ticks to {request.out}", markup=False)
    if request.report is not None:
        side_console().print(f"Wrote the report to {request.report}", markup=False)
    told = account(simulating)
    if request.as_json:
        print_json(told)
    else:
        print_measured(told)
        print_prediction(simulating.prediction())
    return exit_code(simulating.through)


def exit_code(through: Through) -> Exit:
    """3 where the run did not end by itself, 1 where a criterion is not met or not measured."""
    if through.ending.outcome is not Outcome.COMPLETED:
        return Exit.TRIPPED
    met = all(c.outcome is Verdict.PASS for c in through.judged.criteria)
    return Exit.PASSED if met else Exit.FAILED


def _run_through(simulating: Simulating, path: Path | None) -> Refusal | None:
    """Run it, every tick into the file as it comes, where there is one."""
    if path is None:
        for _ in simulating.chunks():
            pass
        return None
    try:
        batches = (as_batch(chunk) for chunk in simulating.chunks())
        write_run(path, batches, lambda: metadata(simulating))
    except OSError as error:
        return Refusal(Code.INVALID_REQUEST, f"--out: cannot write {path}: {error.strerror}")
    return None


def _setup(request: Request) -> Setup | Refusal:
    for option, path in (("--out", request.out), ("--report", request.report)):
        if path is not None and not path.absolute().parent.is_dir():
            return Refusal(Code.INVALID_REQUEST, f"{option}: there is no folder {path.parent}")
    if request.report is not None and request.report.suffix.lower() not in FORMATS:
        known = " or ".join(FORMATS)
        detail = f"--report: {request.report} is none of {known}: its name says what it is to be"
        return Refusal(Code.INVALID_REQUEST, detail)
    definition = find_definition(request.test)
    if isinstance(definition, Refusal):
        return definition
    rig = load_rig_file(request.rig) if request.rig else load_rig()
    if isinstance(rig, Refusal):
        return rig
    controller = load_controller(request.controller) if request.controller else None
    if isinstance(controller, Refusal):
        return controller
    settings = controller or ControllerSettings()
    return Setup(definition, rig, settings, default_interlocks(), request.seed)
