"""`forcerig export`: a recording in the format of another program."""

from dataclasses import dataclass
from pathlib import Path

from app.commands.output import Exit, print_json, print_refusal, progress_bar, side_console
from app.errors import Code, Refusal
from app.exports.extract import Extract, Wanted, extract
from app.exports.formats import FORMATS, FormatName, by_suffix, write
from app.exports.making import UNDER_WAY


@dataclass(frozen=True)
class Request:
    """What was asked for on the command line."""

    recording: Path
    out: Path
    wanted: Wanted
    as_json: bool = False


def run(request: Request) -> Exit:
    """Write the file, and say what is in it."""
    name = _format(request.out)
    if isinstance(name, Refusal):
        return print_refusal(name, request.as_json)
    found = extract(request.recording, request.wanted)
    if isinstance(found, Extract):
        found = FORMATS[name].why_not(found) or found
    if isinstance(found, Refusal):
        return print_refusal(found, request.as_json)
    unwritten = _write(request.out, name, found)
    if unwritten is not None:
        return print_refusal(unwritten, request.as_json)
    _say(request, found)
    return Exit.PASSED


def _format(out: Path) -> FormatName | Refusal:
    name = by_suffix(out)
    if name is None:
        known = ", ".join(f".{format_name}" for format_name in FormatName)
        detail = f"{out.name}: the ending of its name says the format, one of {known}"
        return Refusal(Code.INVALID_REQUEST, detail)
    if not out.absolute().parent.is_dir():
        return Refusal(Code.INVALID_REQUEST, f"There is no folder {out.parent}")
    return name


def _write(out: Path, name: FormatName, found: Extract) -> Refusal | None:
    unfinished = out.with_name(out.name + UNDER_WAY)
    try:
        with progress_bar(f"Writing {FORMATS[name].title}") as progress:
            write(unfinished, name, found, progress)
        unfinished.replace(out)
    except OSError as error:
        return Refusal(Code.INVALID_REQUEST, f"Cannot write {out}: {error.strerror or error}")
    finally:
        unfinished.unlink(missing_ok=True)
    return None


def _say(request: Request, found: Extract) -> None:
    size = request.out.stat().st_size
    if request.as_json:
        told = {"file": str(request.out), "channels": list(found.names), "size_bytes": size}
        print_json(told | {"from_s": found.from_s, "ticks": found.rows()})
        return
    what = f"{found.rows():,} ticks of {len(found.names)} channels"
    side_console().print(f"Wrote {what} to {request.out}, {size / 1e6:,.1f} MB", markup=False)
