"""A load spectrum pasted from a spreadsheet, as the layers of a block."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from app.definitions.blocks import Layer
from app.definitions.limits import RIG
from app.documents.cells import Heading, Style, heading_of, style_of, unit_word
from app.documents.reading import read_data
from app.documents.refusal import Problem
from app.documents.tree import MAX_BYTES
from app.errors import Code, Refusal

_WORDS = (  # what a heading may say of a column, the first that fits
    ("mean_n", ("mean", "mittel", "static", "average", "offset")),
    ("amplitude_n", ("ampl", "dynamic", "alternat")),
    ("frequency_hz", ("freq",)),
    ("cycles", ("cycle", "zykl", "count", "number", "repeat")),
)
_SHORT = {"n": "cycles", "f": "frequency_hz", "hz": "frequency_hz", "amp": "amplitude_n"}
_UNITS = {"mean_n": "N", "amplitude_n": "N", "frequency_hz": "Hz"}
_BARE = (  # columns without headings, by how many there are
    ("mean_n", "amplitude_n", "frequency_hz", "cycles"),
    ("amplitude_n", "frequency_hz", "cycles"),
)
_NEEDED = _BARE[1]


@dataclass(frozen=True)
class Spectrum:
    """The layers that could be read, and what is wrong with each line that could not."""

    layers: tuple[Layer, ...]
    problems: tuple[Problem, ...]


@dataclass(frozen=True)
class _Column:
    place: int
    key: str
    factor: float


def read_spectrum(text: str) -> Spectrum:
    """Layers from CSV, tab- or semicolon-separated text, decimal comma or point.

    Columns may come in any order under headings with units (`Amplitude [kN]`); without headings they
    are mean, amplitude, frequency and cycles, or the last three, in N and Hz.
    """
    if len(text) > MAX_BYTES:
        return _nothing(f"{len(text):,} characters, the limit is {MAX_BYTES:,}")
    lines = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip(" \t;,")]
    if not lines:
        return _nothing("the text is empty")
    if len(lines) > RIG.block_limit + 2:
        return _nothing(f"{len(lines):,} lines, must be at most {RIG.block_limit:,}")
    style = style_of([line for _, line in lines])
    rows = [(i, style.cells(line)) for i, line in lines]
    head = [cells for _, cells in rows[:2] if not _has_number(cells, style)]
    columns = _headed(head) if head else _bare(rows[0][1])
    if isinstance(columns, str):
        return _nothing(columns, rows[0][0])
    return _read(rows[len(head) :], columns, style)


def _read(
    rows: Sequence[tuple[int, list[str]]], columns: Sequence[_Column], style: Style
) -> Spectrum:
    layers: list[Layer] = []
    problems: list[Problem] = []
    for index, (line, cells) in enumerate(rows):
        found = _layer(cells, columns, style)
        if isinstance(found, Layer):
            layers.append(found)
        else:
            path = f"layers[{index}]"
            problems += [
                replace(p, path=f"{path}.{p.path}" if p.path else path, line=line) for p in found
            ]
    if not rows:
        problems.append(Problem("", None, "there are headings, but no layers below them"))
    return Spectrum(tuple(layers), tuple(problems))


def _layer(
    cells: list[str], columns: Sequence[_Column], style: Style
) -> Layer | tuple[Problem, ...]:
    data: dict[str, float] = {}
    for column in columns:
        cell = cells[column.place] if column.place < len(cells) else ""
        value = style.number(cell)
        if value is None and not cell and column.key == "mean_n":
            continue
        if value is None:
            message = f"'{cell[:40]}' is no number" if cell else "is missing"
            return (Problem(column.key, cell[:40], message),)
        if column.key == "cycles" and "," in cell:  # a thousand, or one?
            message = f"'{cell[:40]}' must be a whole number, without commas"
            return (Problem(column.key, cell[:40], message),)
        data[column.key] = value * column.factor
    found = read_data(Layer, data, Code.INVALID_TEST, "layer")
    return found if isinstance(found, Layer) else _problems(found)


def _problems(refusal: Refusal) -> tuple[Problem, ...]:
    return tuple(fault for fault in refusal.faults if isinstance(fault, Problem))


def _headed(head: Sequence[list[str]]) -> list[_Column] | str:
    """The columns under headings, with a row of units below those where there is one."""
    headings = [heading_of(cell) for cell in head[0]]
    if len(head) > 1:
        units = [unit_word(cell) for cell in head[1]]
        found = zip(headings, [*units, *[None] * len(headings)], strict=False)
        headings = [Heading(h.text, h.name, *u) if u else h for h, u in found]
    columns: list[_Column] = []
    for place, heading in enumerate(headings):
        key = _key_of(heading)
        if key is None:
            continue
        if any(column.key == key for column in columns):
            return f"two columns are headed as {key}: '{heading.text}' is the second"
        if key in _UNITS and heading.unit not in (None, _UNITS[key]):
            return f"'{heading.text}' is in {heading.unit}, must be in {_UNITS[key]}"
        columns.append(_Column(place, key, heading.factor if key in _UNITS else 1.0))
    missing = [key for key in _NEEDED if all(column.key != key for column in columns)]
    if missing:
        return f"no column is headed as {' or '.join(missing)}"
    return columns


def _key_of(heading: Heading) -> str | None:
    if heading.name in _SHORT:
        return _SHORT[heading.name]
    fitting = (key for key, words in _WORDS if any(word in heading.name for word in words))
    return next(fitting, None)


def _bare(cells: list[str]) -> list[_Column] | str:
    keys: tuple[str, ...] | None = next((k for k in _BARE if len(k) == len(cells)), None)
    if keys is None:
        return (
            f"{len(cells)} columns without headings, must be 4 (mean, amplitude, frequency, "
            "cycles) or 3 (no mean)"
        )
    return [_Column(place, key, 1.0) for place, key in enumerate(keys)]


def _has_number(cells: list[str], style: Style) -> bool:
    return any(style.number(cell) is not None for cell in cells)


def _nothing(message: str, line: int | None = None) -> Spectrum:
    return Spectrum((), (Problem("", None, message, line=line),))
