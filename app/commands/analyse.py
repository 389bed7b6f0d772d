"""`forcerig analyse static|linear|compensator`: the sheets of a rig under a controller."""

import csv
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from rich.table import Table

from app.commands.output import Exit, print_json, print_refusal, text_console
from app.controller.record import load_controller
from app.controller.settings import ControllerSettings
from app.documents.reading import read_data
from app.errors import Code, Refusal
from app.prediction.rig import load_rig_file
from app.sheets.asked import CompensatorAsked, LinearAsked, StaticAsked
from app.sheets.columns import Columns, of_branch, of_compensator, of_linear, of_loops, of_static
from app.sheets.compensator import compensator_sheet
from app.sheets.linear import linear_sheet
from app.sheets.static import static_sheet
from rtcore.rig.parameters import RigParameters, load_rig

FEW = 10  # rows that stand beside each other
WIDEST = 120  # a table that is cut tells nobody anything


@dataclass(frozen=True)
class Subject:
    """Of which rig and controller, as shipped without a file, and how to print it."""

    rig: Path | None = None
    controller: Path | None = None
    as_json: bool = False
    as_csv: bool = False


def static(subject: Subject, given: Mapping[str, Any]) -> Exit:
    """Print the static characteristic and force gain for each orifice."""

    def make(rig: RigParameters, controller: ControllerSettings) -> BaseModel | Refusal:
        asked = read_data(StaticAsked, given, Code.INVALID_REQUEST, "analyse static")
        return asked if isinstance(asked, Refusal) else static_sheet(rig, asked)

    return _print(subject, make, of_static)


def linear(subject: Subject, given: Mapping[str, Any], bode: bool) -> Exit:
    """Print K_1, K_2, τ and the margins at each amplitude, or the responses."""

    def make(rig: RigParameters, controller: ControllerSettings) -> BaseModel | Refusal:
        asked = read_data(LinearAsked, given, Code.INVALID_REQUEST, "analyse linear")
        return asked if isinstance(asked, Refusal) else linear_sheet(rig, controller, asked)

    return _print(subject, make, of_linear if bode else of_loops)


def compensator(subject: Subject, given: Mapping[str, Any]) -> Exit:
    """Print the response of each part of the branch, and of the loop with it and without."""

    def make(rig: RigParameters, controller: ControllerSettings) -> BaseModel | Refusal:
        asked = read_data(CompensatorAsked, given, Code.INVALID_REQUEST, "analyse compensator")
        return asked if isinstance(asked, Refusal) else compensator_sheet(rig, controller, asked)

    return _print(subject, make, of_compensator, of_branch)


def _print(
    subject: Subject,
    make: Callable[[RigParameters, ControllerSettings], BaseModel | Refusal],
    columns: Callable[[Any], Columns],
    shown: Callable[[Any], Columns] | None = None,
) -> Exit:
    sheet = _made(subject, make)
    if isinstance(sheet, Refusal):
        return print_refusal(sheet, subject.as_json)
    if subject.as_json:
        print_json(sheet.model_dump(mode="json"))
    elif subject.as_csv:
        _print_csv(columns(sheet))
    else:
        _print_table((shown or columns)(sheet))
    return Exit.PASSED


def _made(
    subject: Subject, make: Callable[[RigParameters, ControllerSettings], BaseModel | Refusal]
) -> BaseModel | Refusal:
    if subject.as_json and subject.as_csv:
        return Refusal(Code.INVALID_REQUEST, "Either --json or --csv: leave one of them out")
    rig = load_rig_file(subject.rig) if subject.rig else load_rig()
    if isinstance(rig, Refusal):
        return rig
    controller = load_controller(subject.controller) if subject.controller else ControllerSettings()
    return controller if isinstance(controller, Refusal) else make(rig, controller)


def _rows(columns: Columns) -> Sequence[tuple[float | None, ...]]:
    return list(zip(*columns.values(), strict=True))


def _print_csv(columns: Columns) -> None:
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(_rows(columns))


def _print_table(columns: Columns) -> None:
    """A few rows stand beside each other, a quantity to a line: names with their units are long."""
    rows = _rows(columns)
    table = Table(show_header=len(rows) > FEW)
    for name in columns if len(rows) > FEW else range(len(rows) + 1):
        table.add_column(str(name), justify="right", no_wrap=True)
    lines = [[_said(value) for value in row] for row in rows]
    turned = [[name, *(line[i] for line in lines)] for i, name in enumerate(columns)]
    for line in lines if len(rows) > FEW else turned:
        table.add_row(*line)
    console = text_console()
    console.width = max(console.width, WIDEST)
    console.print(table)


def _said(value: float | None) -> str:
    return "none" if value is None else f"{value:,.6g}"
