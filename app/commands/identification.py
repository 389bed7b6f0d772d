"""`forcerig analyse identification`: the rig model fitted to recorded runs."""

import os
from collections.abc import Sequence
from pathlib import Path

import pyarrow as pa
import yaml
from rich.console import Console
from rich.table import Table

from app.commands.output import Exit, print_json, print_refusal, progress_bar, text_console
from app.definitions.limits import RIG
from app.errors import Code, Refusal
from app.identification.identify import identify
from app.identification.parameters import changed
from app.identification.schemas import Fit, Identified
from app.identification.windows import Source
from app.prediction.rig import load_rig_file
from app.recording.samples import ParquetSamples
from rtcore.rig.parameters import RigParameters, load_rig


def identification(
    runs: Sequence[Path], begin: Path | None, out: Path | None, as_json: bool
) -> Exit:
    """Fit, print, and write the fitted rig; it begins with the rig in a file, or the shipped one."""
    rig = load_rig() if begin is None else load_rig_file(begin)
    if isinstance(rig, Refusal):
        return print_refusal(rig, as_json)
    sources = _sources(runs, rig)
    if isinstance(sources, Refusal):
        return print_refusal(sources, as_json)
    with progress_bar("Identifying") as progress:
        found = identify(sources, rig, Fit(), RIG.period_s, progress, os.cpu_count() or 1)
    if isinstance(found, Refusal):
        return print_refusal(found, as_json)
    if out is not None and (unwritten := _write(changed(rig, found.values()), out)):
        return print_refusal(unwritten, as_json)
    if as_json:
        print_json(found.model_dump(mode="json"))
    else:
        _print(text_console(), found)
    return Exit.PASSED


def _sources(runs: Sequence[Path], rig: RigParameters) -> list[Source] | Refusal:
    sources = []
    for number, path in enumerate(runs, start=1):
        try:
            sources.append(Source(number, ParquetSamples(path), rig.sensors.bits))
        except (OSError, pa.ArrowException, AttributeError, KeyError) as error:
            return Refusal(Code.INVALID_REQUEST, f"{path} is no recording of a run: {error}")
    return sources


def _write(rig: RigParameters, path: Path) -> Refusal | None:
    try:
        text = yaml.safe_dump(rig.model_dump(), sort_keys=False, allow_unicode=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        return Refusal(Code.INVALID_REQUEST, f"--out: cannot write {path}: {error.strerror}")
    return None


def _print(console: Console, found: Identified) -> None:
    table = Table("parameter", "unit", "before", "after", "interval", "to be noted")
    for p in found.parameters:
        half = (
            f"± {(p.high - p.low) / 2:.2g}"
            if p.half_percent is None
            else f"± {p.half_percent:.2g} %"
        )
        noted = "" if p.determined else "not told by these runs"
        if p.entangled is not None:
            noted += f" with {p.entangled.path} {p.entangled.correlation:+.2f}"
        figures = f"{p.before:.5g}", f"{p.after:.5g}", half
        table.add_row(p.path, p.unit, *figures, noted.strip())
    console.print(table)
    before, after = found.goodness.before_percent, found.goodness.after_percent
    if before is not None and after is not None:
        console.print(
            f"G, eq (4), of windows not fitted to: {before:.2f} % before, {after:.2f} % after"
        )
    for note in found.notes:
        console.print(note, markup=False)
