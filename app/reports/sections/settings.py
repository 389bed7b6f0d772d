"""Everything that the run was made with, as it was frozen: definition, controller, interlocks, rig."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from app.documents.units import unit_of
from app.reports.numbers import digits, quantity, spoken
from app.reports.report import Column, Item, Row, Section, Table
from app.reports.subject import Subject
from rtcore.interlocks import Form, Quantity

LONGEST = 24  # items of a list that are shown
_TWO = (Column("Setting", share=3.0), Column("Value", share=4.0))


def settings(subject: Subject) -> Section:
    """The frozen documents as tables."""
    frozen = subject.frozen
    items: list[Item] = [_table("Definition of the test", frozen.definition)]
    items.append(_table("Controller", frozen.controller))
    items.append(_detectors(frozen.interlocks))
    items.append(_table("Rig", frozen.rig))
    return Section("Settings", tuple(items), own_page=True)


def _table(caption: str, document: Mapping[str, Any]) -> Table:
    rows = tuple(Row((path, value)) for path, value in _leaves(document))
    return Table(caption, _TWO, rows)


def _leaves(value: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """Every value of a document with where it is; nothing of what is not set."""
    if isinstance(value, Mapping):
        for name, inner in value.items():
            yield from _leaves(inner, f"{path}.{name}" if path else str(name))
    elif isinstance(value, Sequence) and not isinstance(value, str):
        yield from _list(value, path)
    elif value is not None:
        yield path, _written(value)


def _list(values: Sequence[Any], path: str) -> Iterator[tuple[str, str]]:
    if not any(isinstance(value, Mapping | list | tuple) for value in values):
        shown = ", ".join(_written(value) for value in values[:LONGEST])
        more = f" … {len(values):,} in all" if len(values) > LONGEST else ""
        yield path, (shown + more) or "none"
        return
    for i, value in enumerate(values[:LONGEST]):
        yield from _leaves(value, f"{path}[{i}]")
    if len(values) > LONGEST:
        yield path, f"{len(values) - LONGEST:,} more"


def _written(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, int | float):
        return str(value)
    return digits(float(value), 6)  # the unit is the last word of the name


def _detectors(document: Mapping[str, Any]) -> Table:
    columns = (
        Column("Detector", share=3.0),
        Column("Watches", share=3.0),
        Column("Limit", number=True, share=2.2),
        Column("Lasting", number=True, share=1.2),
        Column("Action", share=1.4),
    )
    rows = tuple(_detector(d) for d in document.get("detectors", ()))
    return Table("Interlocks", columns, rows)


def _detector(d: Mapping[str, Any]) -> Row:
    low = d.get("low")
    limit = digits(d["threshold"]) if low is None else f"{digits(low)} … {digits(d['threshold'])}"
    form = "" if d["form"] == Form.VALUE.name.lower() else f", {d['form'].replace('_', ' ')}"
    unit = _unit_of(d["quantity"])
    lasting = quantity(d["persistence_s"], "s") if d.get("persistence_s") else "at once"
    action = d["action"] if d.get("enabled", True) else "off"
    cells = (
        spoken(d["name"]),
        f"{spoken(d['quantity'])}{form}",
        f"{limit} {unit}".strip(),
        lasting,
    )
    return Row((*cells, action.replace("_", " ")))


def _unit_of(name: str) -> str:
    return unit_of(name) or "" if name.upper() in Quantity.__members__ else ""
