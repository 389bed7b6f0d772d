"""What a lab makes its own: a logo on the first page, and a template of its own instead of ours."""

from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from app.errors import Code, Refusal

LOGO_KINDS = {".svg": "image/svg+xml", ".png": "image/png", ".jpg": "image/jpeg"}
LARGEST_BYTES = 5_000_000
_OURS = files("app.reports") / "template"


@dataclass(frozen=True)
class Branding:
    """Typst and HTML templates, and a logo: its ending (`.svg`) and content."""

    typst: str
    html: str
    logo: tuple[str, bytes] | None = None


def branding(logo: Path | None, template: Path | None) -> Branding | Refusal:
    """Read the files; refused where one cannot be used. Without them, ours."""
    typst = _template(template)
    if isinstance(typst, Refusal):
        return typst
    drawn = None if logo is None else _logo(logo)
    if isinstance(drawn, Refusal):
        return drawn
    return Branding(typst, (_OURS / "report.html.j2").read_text("utf-8"), drawn)


def _template(path: Path | None) -> str | Refusal:
    if path is None:
        return (_OURS / "report.typ").read_text("utf-8")
    try:
        return path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        return _unusable("template", path, error)


def _logo(path: Path) -> tuple[str, bytes] | Refusal:
    ending = path.suffix.lower()
    if ending not in LOGO_KINDS:
        known = ", ".join(LOGO_KINDS)
        return Refusal(Code.INVALID_REPORT, f"The logo of reports, {path.name}, is none of {known}")
    try:
        content = path.read_bytes()
    except OSError as error:
        return _unusable("logo", path, error)
    if len(content) > LARGEST_BYTES:
        detail = f"The logo of reports, {path.name}, is larger than {LARGEST_BYTES / 1e6:g} MB"
        return Refusal(Code.INVALID_REPORT, detail)
    return ending, content


def _unusable(what: str, path: Path, error: Exception) -> Refusal:
    why = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
    detail = f"The {what} of reports, {path.name}, cannot be read: {why}; look at FORCERIG_REPORT_{what.upper()}"
    return Refusal(Code.INVALID_REPORT, detail)
