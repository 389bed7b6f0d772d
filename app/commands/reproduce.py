"""`forcerig reproduce figure-12`: figures of the paper as data, picture and a page of a report."""

from pathlib import Path

from rich.table import Table

from app.commands.output import (
    Exit,
    print_json,
    print_refusal,
    progress_bar,
    side_console,
    text_console,
)
from app.documents.messages import nearest
from app.errors import Code, Refusal
from app.reports.branding import branding
from app.reports.numbers import quantity
from app.reproduce.made import Reproduced
from app.reproduce.registry import FIGURES
from app.reproduce.writing import document, write
from app.settings import Settings

ALL = "all"


def run(name: str, out: Path, as_json: bool) -> Exit:
    """Compute one figure, or all, write its files, and print its numbers beside the paper's."""
    wanted = list(FIGURES) if name == ALL else [name]
    unknown = _unknown(name)
    if unknown is not None and name != ALL:
        return print_refusal(unknown, as_json)
    settings = Settings()
    look = branding(settings.report_logo, settings.report_template)
    if isinstance(look, Refusal):
        return print_refusal(look, as_json)
    documents = []
    for one in wanted:
        with progress_bar(f"Reproducing {one}") as progress:
            made = FIGURES[one](progress)
        try:
            written = write(made, out, look)
        except OSError as error:
            detail = f"--out: cannot write in {out}: {error.strerror}"
            return print_refusal(Refusal(Code.INVALID_REQUEST, detail), as_json)
        if isinstance(written, Refusal):
            return print_refusal(written, as_json)
        side_console().print(
            f"Wrote {', '.join(path.name for path in written)} in {out}", markup=False
        )
        documents.append(document(made))
        if not as_json:
            _print(made)
    if as_json:
        print_json(documents[0] if name != ALL else documents)
    return Exit.PASSED


def _unknown(name: str) -> Refusal | None:
    if name in FIGURES:
        return None
    listed = ", ".join([*FIGURES, ALL])
    detail = f"There is no '{name}' to reproduce{nearest(name, FIGURES)} Known: {listed}"
    return Refusal(Code.INVALID_REQUEST, detail)


def _print(made: Reproduced) -> None:
    table = Table(title=f"{made.name}: {made.caption}")
    table.add_column("")
    for heading in ("this rig", "paper", "data sheet"):
        table.add_column(heading, justify="right")
    for number in made.numbers:
        values = (number.ours, number.paper, number.sheet)
        table.add_row(number.what, *(quantity(value, number.unit) for value in values))
    console = text_console()
    console.print(table)
    for text in made.honest:
        console.print(f"· {text}", markup=False, soft_wrap=True)
