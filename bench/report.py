"""How a benchmark shows its figures: a table on a terminal, or one JSON document."""

import json
import platform
import sys
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TypeVar

from rich.console import Console
from rich.progress import track
from rich.table import Table

T = TypeVar("T")

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_PREFIXED = frozenset({"s", "Hz", "B", "B/s", "1/s"})


@dataclass(frozen=True)
class Figure:
    """One measured value in SI; None where there is none, and then `note` says why.

    `name` is a key for programs, with its unit last (`wakeup_median_s`); `what` is for people.
    A figure with neither limit is for information. A ratio has the unit "×".
    """

    name: str
    what: str
    value: float | None
    unit: str
    at_most: float | None = None
    at_least: float | None = None
    note: str = ""

    @property
    def met(self) -> bool | None:
        """Whether the target is met; None where there is none, or nothing was measured."""
        if self.value is None or (self.at_most is None and self.at_least is None):
            return None
        below = self.at_most is None or self.value <= self.at_most
        return below and (self.at_least is None or self.value >= self.at_least)

    @property
    def target(self) -> str:
        """The target in words; empty where there is none."""
        limits = (("≤", self.at_most), ("≥", self.at_least))
        return " ".join(f"{sign} {quantity(v, self.unit)}" for sign, v in limits if v is not None)


def quantity(value: float | None, unit: str) -> str:
    """A value with its unit, to three digits: 2.1e-6 s is "2.10 µs"."""
    if value is None:
        return "—"
    if unit in _PREFIXED and value != 0:
        scale, prefix = next((p for p in _PREFIXES if abs(value) >= p[0]), _PREFIXES[-1])
        return f"{digits(value / scale)} {prefix}{unit}"
    return f"{digits(value)} {unit}".rstrip(" -")


def digits(value: float) -> str:
    """Three significant digits, never in powers of ten; whole numbers as they are."""
    if abs(value) >= 100 or abs(value - round(value)) < 1e-9:
        return f"{value:.0f}"
    return f"{value:.2f}" if abs(value) < 10 else f"{value:.1f}"


def machine() -> dict[str, str | int | None]:
    """What the figures were measured on."""
    words = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    named = dict(line.split(":", 1) for line in words.splitlines() if ":" in line)
    return {
        "processor": named.get("model name\t", platform.machine()).strip(),
        "processors": words.count("processor\t") or None,
        "virtual": "hypervisor" in words,
        "kernel": platform.release(),
        "python": platform.python_version(),
    }


def show(bench: str, figures: list[Figure], notes: list[str], as_json: bool) -> None:
    """Print the figures of one benchmark, with their targets and with what the machine is."""
    if as_json:
        rows = [asdict(figure) | {"met": figure.met} for figure in figures]
        document = {"bench": bench, "machine": machine(), "figures": rows, "notes": notes}
        print(json.dumps(document, ensure_ascii=False, indent=2))
        return
    table = Table("figure", "measured", "target", "", "note", title=f"bench {bench}")
    for figure in figures:
        mark = {True: "[green]met", False: "[red]missed", None: ""}[figure.met]
        value = quantity(figure.value, figure.unit)
        table.add_row(figure.what, value, figure.target, mark, figure.note)
    console = Console(highlight=False)
    console.print(table)
    of = machine()
    kind = "virtual machine, so only ratios carry over" if of["virtual"] else "real machine"
    console.print(f"{of['processor']}, {of['processors']} processors, {of['kernel']}; {kind}")
    for note in notes:
        console.print(f"· {note}")


def progress(message: str) -> None:
    """Say what goes on, on standard error: standard output is for the figures alone."""
    print(message, file=sys.stderr, flush=True)


def tracked(items: Sequence[T], what: str) -> Iterable[T]:
    """The items, with a bar on standard error that tells the time left."""
    return track(items, what, console=Console(stderr=True), transient=True)
