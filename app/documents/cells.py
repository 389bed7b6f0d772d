"""Tables pasted or saved from a spreadsheet: their delimiter, decimal sign, and headings with units."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_COMMA_NUMBER = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?")

_UNITS: dict[str, tuple[str, float]] = {  # as written, or in small letters: SI unit and factor
    "n": ("N", 1.0),
    "kn": ("N", 1e3),
    "MN": ("N", 1e6),
    "mN": ("N", 1e-3),
    "m": ("m", 1.0),
    "cm": ("m", 1e-2),
    "mm": ("m", 1e-3),
    "um": ("m", 1e-6),
    "µm": ("m", 1e-6),
    "μm": ("m", 1e-6),
    "s": ("s", 1.0),
    "sec": ("s", 1.0),
    "ms": ("s", 1e-3),
    "us": ("s", 1e-6),
    "µs": ("s", 1e-6),
    "min": ("s", 60.0),
    "hz": ("Hz", 1.0),
    "khz": ("Hz", 1e3),
}
_HEADING = re.compile(
    r"^(?P<name>.*?)\s*(?:\[(?P<a>[^\]]*)\]|\((?P<b>[^)]*)\)|/\s*(?P<c>\S+)|\bin\s+(?P<d>\S+)"
    r"|_(?P<e>[A-Za-zµμ]+))\s*$"
)


@dataclass(frozen=True)
class Style:
    """How a table is written."""

    delimiter: str
    decimal: str

    def cells(self, line: str) -> list[str]:
        """The cells of a line, without quotes and blanks around them."""
        return [cell.strip().strip('"').strip() for cell in line.split(self.delimiter)]

    def number(self, cell: str) -> float | None:
        """A cell as a number; None where it is none. NaN and infinity are none."""
        text = cell.replace(",", ".") if self.decimal == "," else cell
        value = float(text) if _NUMBER.fullmatch(text) else math.inf
        return value if math.isfinite(value) else None


@dataclass(frozen=True)
class Heading:
    """A column: its name in lower case, its SI unit where it has one, and the factor to that."""

    text: str
    name: str
    unit: str | None
    factor: float


def style_of(lines: Sequence[str]) -> Style:
    """How these lines are written: tab or semicolon before comma, a decimal comma where one is seen."""
    delimiter = next((d for d in "\t;" if any(d in line for line in lines)), ",")
    if delimiter != ",":
        cells = (cell.strip() for line in lines for cell in line.split(delimiter))
        return Style(delimiter, "," if any(_COMMA_NUMBER.fullmatch(c) for c in cells) else ".")
    # One column with a decimal comma looks like two, but its heading does not.
    heading, *rows = lines or [""]
    alone = "," not in heading and all(_COMMA_NUMBER.fullmatch(row.strip()) for row in rows)
    return Style(";", ",") if rows and alone else Style(",", ".")


def heading_of(text: str) -> Heading:
    """`Force [kN]`, `force_kn`, `Force / kN`, `kN` and `force in kN` all say the same."""
    found = _HEADING.match(text.strip())
    written = next((part for part in found.groups()[1:] if part is not None), "") if found else ""
    known = _unit(written.strip())
    if found and (known or found["e"] is None):
        unit, factor = known or (None, 1.0)
        return Heading(text, _plain(found["name"]), unit, factor)
    unit, factor = _unit(text.strip()) or (None, 1.0)
    return Heading(text, _plain(text), unit, factor)


def unit_word(text: str) -> tuple[str, float] | None:
    """A unit as it stands in a row of units, `[kN]` or `kN`: SI unit and factor."""
    return _unit(text.strip().strip("[]()").strip())


def _unit(text: str) -> tuple[str, float] | None:
    return _UNITS.get(text) or _UNITS.get(text.lower())


def _plain(name: str) -> str:
    return re.sub(r"[\s_-]+", "_", name.strip().lower())
