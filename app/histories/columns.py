"""The numbers of a CSV file, a few megabytes at a time: quickly by Arrow, and line by line where that finds fault."""

import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa
from pyarrow import csv

from app.documents.units import say
from app.histories.curve import LARGEST, Values
from app.histories.layout import Layout, Unreadable

BLOCK_BYTES = 8 << 20


def read_columns(path: Path, layout: Layout) -> Iterator[tuple[Values | None, Values]]:
    """(times in s or None, values in N or m), part after part. Raises `Unreadable` with the line."""
    line = layout.first_line
    for block in _blocks(path, layout.first_line):
        found = _quickly(block, layout) or _carefully(block, layout, line)
        line += block.count(b"\n")
        times, values = found
        yield times if times is None else times * layout.time_factor, values * layout.factor


def line_of(path: Path, layout: Layout, index: int) -> int:
    """The line on which the sample of an index stands, from 1."""
    seen, line = -1, 0
    with path.open("rb") as file:
        for line, text in enumerate(file, 1):
            seen += line >= layout.first_line and bool(text.strip())
            if seen == index:
                break
    return line


def _blocks(path: Path, first_line: int) -> Iterator[bytes]:
    """Whole lines, so many bytes of them at a time."""
    with path.open("rb") as file:
        for _ in range(first_line - 1):
            file.readline()
        while block := file.read(BLOCK_BYTES):
            yield block + file.readline()


def _quickly(block: bytes, layout: Layout) -> tuple[Values | None, Values] | None:
    """The block's numbers, or None where anything in it is doubtful."""
    wanted = [layout.value] if layout.time is None else [layout.time, layout.value]
    names = [str(i) for i in range(layout.columns)]
    try:
        table = csv.read_csv(
            io.BytesIO(block),
            csv.ReadOptions(column_names=names, use_threads=False, block_size=len(block) + 1),
            csv.ParseOptions(delimiter=layout.style.delimiter),
            csv.ConvertOptions(
                column_types={str(i): pa.float64() for i in wanted},
                include_columns=[str(i) for i in dict.fromkeys(wanted)],
                decimal_point=layout.style.decimal,
                null_values=[],
            ),
        )
    except pa.ArrowInvalid:
        return None
    columns = [np.asarray(table.column(str(i)), np.float64) for i in wanted]
    if not all((np.abs(column) <= LARGEST).all() for column in columns):
        return None
    return (None if layout.time is None else columns[0]), columns[-1]


def _carefully(block: bytes, layout: Layout, line: int) -> tuple[Values | None, Values]:
    """The block's numbers line by line. Raises `Unreadable` at the first that is none."""
    times, values = [], []
    for number, text in enumerate(decoded(block).split("\n"), line):
        if text.strip():
            cells = layout.style.cells(text)
            values.append(_number(cells, layout.value, layout, number))
            if layout.time is not None:
                times.append(_number(cells, layout.time, layout, number))
    return (None if layout.time is None else np.array(times)), np.array(values, np.float64)


def _number(cells: list[str], column: int, layout: Layout, line: int) -> float:
    if column >= len(cells):
        message = f"has {len(cells)} of {layout.columns} columns"
        raise Unreadable(message, line)
    value = layout.style.number(cells[column])
    if value is None:
        what = f"'{cells[column][:40]}' is no number" if cells[column] else "a value is missing"
        raise Unreadable(f"{what} (column {column + 1})", line)
    if abs(value) > LARGEST:
        raise Unreadable(f"{say(value)} is too large (column {column + 1})", line)
    return value


def decoded(text: bytes) -> str:
    """Text as spreadsheets save it. Raises `Unreadable` for UTF-16."""
    if text[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise Unreadable("the file is in UTF-16: save it as CSV in UTF-8", 1)
    try:
        return text.decode("utf-8-sig")
    except UnicodeDecodeError:
        return text.decode("cp1252", errors="replace")
