"""The files of a run: parts while it goes on, one Parquet file when it is over."""

import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from app.recording.outcome import Ending
from app.recording.parquet import write_run
from app.recording.parts import extent_of, part_paths, read_parts
from app.recording.run_file import Recorded

_log = logging.getLogger(__name__)


def parquet_path(folder: Path) -> Path:
    """The file of a run that is over."""
    return folder / "run.parquet"


def convert(
    folder: Path, frozen: Mapping[str, Any], recorded: Recorded, ending: Ending
) -> Recorded:
    """Make the Parquet file of a run from its parts: under another name, then in one step.

    Returns what is in it: `recorded`, unless the disk did not keep what it was given.
    """
    if not part_paths(folder):
        return recorded  # the file was made before, and the parts removed
    readable = extent_of(folder).ticks
    if readable != recorded.ticks:
        text = "%s: %d of %d recorded ticks can be read back; the parts are kept as they are"
        _log.error(text, folder, readable, recorded.ticks)
        expected = recorded.last_tick - recorded.first_tick + 1
        recorded = recorded._replace(ticks=readable, missing_ticks=expected - readable)
    how = {"outcome": ending.outcome.value, "reason": ending.reason}
    if readable:
        metadata = {**frozen, **recorded._asdict(), **how}
        write_run(parquet_path(folder), read_parts(folder), metadata)
    return recorded


def remove_parts(folder: Path) -> None:
    """Remove the parts of a run whose file is in place."""
    for path in part_paths(folder):
        path.unlink()


def keep_parts(folder: Path) -> None:
    """Put the parts of a run out of the way: not all of them could be read."""
    for path in part_paths(folder):
        path.rename(path.with_name(f"{path.name}.damaged"))
