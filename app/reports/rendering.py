"""A report as PDF or HTML. The same report gives the same bytes: no clock, no fonts of the machine's."""

import base64
import json
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import typst
from jinja2 import Environment, StrictUndefined

from app.errors import Code, Refusal
from app.reports.branding import LOGO_KINDS, Branding
from app.reports.fonts import figure_fonts
from app.reports.report import Facts, Figure, Item, Report, Table, Words

_FORMAT = {"format": "pdf", "ignore_system_fonts": True, "font_paths": [str(figure_fonts())]}
BEFORE_ALL_TIME_S = 0  # the PDF's own date, where a run has none


def render_pdf(report: Report, branding: Branding) -> bytes | Refusal:
    """PDF; refused where the template is wrong, with what it says of that."""
    figures: dict[str, bytes] = {}
    data = _told(report, figures)
    if branding.logo is not None:
        data["logo"] = f"logo{branding.logo[0]}"
        figures[data["logo"]] = branding.logo[1]
    world = {"main.typ": branding.typst.encode(), "report.json": _json(data), **figures}
    dated = BEFORE_ALL_TIME_S if report.dated is None else int(report.dated.timestamp())
    try:
        made = typst.compile(world, **_FORMAT, timestamp=dated)  # type: ignore[call-overload]  # it takes files by name
    except typst.TypstError as error:
        return Refusal(Code.INVALID_REPORT, f"The report cannot be set: {_first_line(error)}")
    assert isinstance(made, bytes)
    return made


def render_html(report: Report, branding: Branding) -> bytes:
    """One page that needs nothing besides itself."""
    environment = Environment(autoescape=True, undefined=StrictUndefined)
    figures: dict[str, bytes] = {}
    data = _told(report, figures)
    sources = {name: _as_url("image/svg+xml", svg) for name, svg in figures.items()}
    for item in _figures(data):
        item["source"] = sources[item["file"]]
    logo = branding.logo
    shown = None if logo is None else _as_url(LOGO_KINDS[logo[0]], logo[1])
    return environment.from_string(branding.html).render(r=data, logo=shown).encode()


def _told(report: Report, figures: dict[str, bytes]) -> dict[str, Any]:
    """All of a report as JSON has it; its figures go into files of their own."""
    return {
        "title": report.title,
        "subtitle": report.subtitle,
        "label": report.label,
        "software": report.software,
        "logo": None,
        "verdict": asdict(report.verdict),
        "about": [_item(it, figures) for it in report.about],
        "sections": [
            {
                "title": section.title,
                "own_page": section.own_page,
                "items": [_item(it, figures) for it in section.items],
            }
            for section in report.sections
        ],
    }


def _item(it: Item, figures: dict[str, bytes]) -> dict[str, Any]:
    match it:
        case Figure():
            name = f"figure-{len(figures)}.svg"
            figures[name] = it.svg
            return {"kind": it.kind, "file": name, "caption": it.caption, "told": it.told}
        case Words() | Facts() | Table():
            return asdict(it)


def _figures(data: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for items in (data["about"], *(section["items"] for section in data["sections"])):
        yield from (it for it in items if it["kind"] == "figure")


def _json(data: dict[str, Any]) -> bytes:
    return json.dumps(data, ensure_ascii=False, allow_nan=False, sort_keys=True).encode()


def _as_url(kind: str, content: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def _first_line(error: typst.TypstError) -> str:
    return str(error.message).splitlines()[0] if error.message else "its template has an error"
