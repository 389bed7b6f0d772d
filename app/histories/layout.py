"""How a CSV file of a time history is laid out: its style, where its data begin, which columns they are in."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NoReturn

from app.documents.cells import Heading, Style, heading_of, style_of, unit_word
from app.documents.messages import nearest

_TIMES = {"t", "time", "zeit", "temps", "tiempo", "elapsed_time"}


class Unreadable(Exception):
    """A file that is no time history; `line` counts from 1 where one is to blame."""

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.line = line


@dataclass(frozen=True)
class Layout:
    """Where samples are: columns count from 0, `time` is None where the file has no times."""

    style: Style
    first_line: int  # of data, from 1
    columns: int
    value: int
    unit: str | None  # N or m, where the heading says so
    factor: float  # to SI
    heading: str
    time: int | None
    time_factor: float  # to s


def layout_of(lines: Sequence[str], column: str | None, timed: bool) -> Layout:
    """The layout of a file that begins with these lines.

    `column` chooses by heading, name or number from 1; `timed` says that the rate is known, so that
    two bare columns need not be time and value. Raises `Unreadable`.
    """
    begun = [i for i, line in enumerate(lines) if line.strip() and not line.startswith("#")]
    if not begun:
        raise Unreadable("the file holds no data")
    style = style_of([lines[i].rstrip("\r\n") for i in begun])
    head: list[list[str]] = []
    for i in begun:
        cells = style.cells(lines[i].rstrip("\r\n"))
        if any(style.number(cell) is not None for cell in cells):
            return _laid_out(style, head, i + 1, len(cells), column, timed)
        head.append(cells)
    raise Unreadable("no line holds a number", begun[0] + 1)


def _laid_out(
    style: Style,
    head: list[list[str]],
    first_line: int,
    columns: int,
    column: str | None,
    timed: bool,
) -> Layout:
    headings = _headings(head, columns)
    time = _time_column(headings, bool(head), timed)
    value = _value_column(headings, time, column)
    return Layout(
        style,
        first_line,
        columns,
        value,
        headings[value].unit,
        headings[value].factor,
        headings[value].text,
        time,
        1.0 if time is None else headings[time].factor,
    )


def _headings(head: list[list[str]], columns: int) -> list[Heading]:
    """The heading of each column: names, with a row of units below them where there is one."""
    units = [unit_word(cell) for cell in head[-1]] if len(head) > 1 else []
    has_units = any(units) and all(
        u or not c.strip("[]()- ") for u, c in zip(units, head[-1], strict=False)
    )
    names = head[-2] if has_units else head[-1] if head else []
    headings = [heading_of(cell) for cell in (names + [""] * columns)[:columns]]
    if not has_units:
        return headings
    found = zip(headings, (units + [None] * columns)[:columns], strict=True)
    return [Heading(h.text, h.name, *u) if u else h for h, u in found]


def _time_column(headings: list[Heading], headed: bool, timed: bool) -> int | None:
    by_name = (i for i, h in enumerate(headings) if h.name in _TIMES or h.unit == "s")
    if headed:
        return next(by_name, None)
    return 0 if len(headings) > 1 and not timed else None


def _value_column(headings: list[Heading], time: int | None, column: str | None) -> int:
    others = [i for i in range(len(headings)) if i != time]
    if column is not None:
        return _chosen(headings, column)
    fitting = [i for i in others if headings[i].unit in ("N", "m")]
    for found in (others, fitting):
        if len(found) == 1:
            _refuse_foreign(headings[found[0]])
            return found[0]
    if not others:
        raise Unreadable("there is a column of times but none of values")
    raise Unreadable(f"which column? {_listed(headings, others)}")


def _chosen(headings: list[Heading], column: str) -> int:
    wanted = column.strip().lower()
    for i, heading in enumerate(headings):
        if wanted in (heading.text.lower(), heading.name, str(i + 1)):
            _refuse_foreign(heading)
            return i
    guess = (
        nearest(column, [h.text for h in headings])
        or f": {_listed(headings, range(len(headings)))}"
    )
    raise Unreadable(f"there is no column '{column}'{guess}")


def _refuse_foreign(heading: Heading) -> None:
    if heading.unit not in (None, "N", "m"):
        _foreign(heading)


def _foreign(heading: Heading) -> NoReturn:
    raise Unreadable(f"the column '{heading.text}' is in {heading.unit}, must be in N or m")


def _listed(headings: list[Heading], columns: Sequence[int]) -> str:
    return ", ".join(headings[i].text or str(i + 1) for i in columns)
