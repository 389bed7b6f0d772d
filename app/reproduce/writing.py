"""A reproduced figure as files: data (CSV a sheet, JSON of all), PNG, and a page of a report (PDF)."""

import csv
import io
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from app.errors import Refusal
from app.recording.whole_file import whole_file
from app.reports.branding import Branding
from app.reports.figures.style import as_png, as_svg, styled
from app.reports.numbers import quantity
from app.reports.rendering import render_pdf
from app.reports.report import Column, Figure, Report, Row, Table, Tone, Verdict, Words
from app.reproduce.made import Beside, Reproduced, Sheet
from app.settings import VERSION


def write(made: Reproduced, folder: Path, look: Branding) -> list[Path] | Refusal:
    """Its files, in the folder, which is made where there is none. Raises `OSError`."""
    with styled():
        png = as_png(made.draw())
    pdf = render_pdf(page(made), look)
    if isinstance(pdf, Refusal):
        return pdf
    folder.mkdir(parents=True, exist_ok=True)
    contents = {f"{made.name}.json": as_json(made).encode(), f"{made.name}.png": png}
    contents |= {f"{made.name}.pdf": pdf}
    contents |= {f"{made.name}-{sheet.name}.csv": as_csv(sheet).encode() for sheet in made.sheets}
    for name, content in contents.items():
        with whole_file(folder / name) as file:
            file.write(content)
    return [folder / name for name in contents]


def page(made: Reproduced) -> Report:
    """The page of a report."""
    with styled():
        svg = as_svg(made.draw())
    number = made.name.removeprefix("figure-")
    items = (Figure("", svg, made.caption), _table(made.numbers))
    words = tuple(Words(text) for text in made.honest)
    sentence = (
        "Computed by the very tick of the loop on the virtual rig, beside the paper's numbers"
    )
    return Report(
        title="Reproduction of the paper",
        subtitle=f"Figure {number}: {made.caption}",
        label=made.name,
        verdict=Verdict(f"FIGURE {number}", sentence, Tone.QUIET),
        about=(*items, *words),
        sections=(),
        dated=None,
        software=f"forcerig {VERSION}",
    )


def document(made: Reproduced) -> dict[str, Any]:
    """Its numbers and data in types that JSON knows."""
    numbers = [
        {**vars(n), "ours": _finite(n.ours), "paper": n.paper, "sheet": n.sheet}
        for n in made.numbers
    ]
    sheets = {
        sheet.name: {
            name: [_finite(v) for v in values.tolist()] for name, values in sheet.columns.items()
        }
        for sheet in made.sheets
    }
    honest = list(made.honest)
    told = {"figure": made.name, "caption": made.caption, "numbers": numbers, "notes": honest}
    return told | {"data": sheets}


def as_json(made: Reproduced) -> str:
    """The same as text."""
    return json.dumps(document(made), ensure_ascii=False, indent=1, allow_nan=False) + "\n"


def as_csv(sheet: Sheet) -> str:
    """Names with their units in the first line."""
    written = io.StringIO()
    lines = csv.writer(written, lineterminator="\n")
    lines.writerow(sheet.columns)
    lines.writerows(_lines(sheet))
    return written.getvalue()


def _lines(sheet: Sheet) -> Iterator[tuple[str, ...]]:
    for row in zip(*sheet.columns.values(), strict=True):
        yield tuple(f"{value:.9g}" for value in row)


def _table(numbers: tuple[Beside, ...]) -> Table:
    columns = (
        Column("", share=4.0),
        Column("This rig", number=True, share=1.5),
        Column("Paper", number=True, share=1.5),
        Column("Data sheet", number=True, share=1.5),
        Column("", share=3.0),
    )
    rows = tuple(
        Row((n.what, *(quantity(v, n.unit) for v in (n.ours, n.paper, n.sheet)), n.note))
        for n in numbers
    )
    return Table(
        "Numbers beside the paper's, and beside the data sheet of the virtual rig", columns, rows
    )


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
