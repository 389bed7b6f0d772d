"""`forcerig simulate`: a test on the virtual rig, its measurements and its verdict."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.table import Table

from app.analysis.acceptance import Verdict
from app.commands.output import (
    Exit,
    print_json,
    print_refusal,
    progress_bar,
    side_console,
    text_console,
)
from app.commands.which_test import find_definition
from app.controller.record import load_controller
from app.controller.settings import ControllerSettings
from app.documents.units import say
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.prediction.account import account, metadata
from app.prediction.rig import load_rig_file
from app.prediction.simulation import Setup, Simulation, simulate
from app.recording.columns import as_batch
from app.recording.outcome import Outcome
from app.recording.parquet import write_run
from rtcore.rig.parameters import load_rig

MARKS = {Verdict.PASS: "green", Verdict.FAIL: "red", Verdict.UNSET: "yellow"}


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
        simulation = simulate(setup, progress)
    if isinstance(simulation, Refusal):
        return print_refusal(simulation, request.as_json)
    if request.out is not None:
        unwritten = _write(simulation, request.out)
        if unwritten is not None:
            return print_refusal(unwritten, request.as_json)
    told = account(simulation)
    if request.as_json:
        print_json(told)
    else:
        _print(told)
    return exit_code(simulation)


def exit_code(simulation: Simulation) -> Exit:
    """3 where the run did not end by itself, 1 where a criterion is not met or not measured."""
    if simulation.run.ending.outcome is not Outcome.COMPLETED:
        return Exit.TRIPPED
    met = all(c.outcome is Verdict.PASS for c in simulation.judged.criteria)
    return Exit.PASSED if met else Exit.FAILED


def _setup(request: Request) -> Setup | Refusal:
    if request.report is not None:
        detail = "--report is not available yet in this version of forcerig: leave it out"
        return Refusal(Code.INVALID_REQUEST, detail)
    if request.out is not None and not request.out.absolute().parent.is_dir():
        return Refusal(Code.INVALID_REQUEST, f"--out: there is no folder {request.out.parent}")
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


def _write(simulation: Simulation, path: Path) -> Refusal | None:
    try:
        write_run(path, [as_batch(simulation.run.records)], metadata(simulation))
    except OSError as error:
        return Refusal(Code.INVALID_REQUEST, f"--out: cannot write {path}: {error.strerror}")
    side_console().print(f"Wrote {len(simulation.run.records):,} ticks to {path}", markup=False)
    return None


def _print(told: dict[str, Any]) -> None:
    console = text_console()
    console.print(told["test"], style="bold", markup=False)
    console.print(f"{told['outcome'].capitalize()} after {say(told['duration_s'], 's')}")
    if told["reason"]:
        console.print(told["reason"], style="red", markup=False)
    measured = Table("measurement", "unit")
    measured.add_column("value", justify="right")
    for m in told["measurements"]:
        if m["value"] is not None:
            measured.add_row(m["name"], m["unit"], say(m["value"]))
    console.print(measured)
    if told["acceptance"]:
        console.print(_criteria(told))
    console.print(f"Verdict: {told['verdict']}", style=MARKS[Verdict(told["verdict"])])


def _criteria(told: dict[str, Any]) -> Table:
    table = Table("acceptance")
    for heading in ("at least", "value", "at most", "outcome"):
        table.add_column(heading, justify="right")
    for c in told["acceptance"]:
        numbers = (c["at_least"], c["value"], c["at_most"])
        shown = ("" if number is None else say(number) for number in numbers)
        table.add_row(c["measurement"], *shown, c["outcome"], style=MARKS[Verdict(c["outcome"])])
    return table
