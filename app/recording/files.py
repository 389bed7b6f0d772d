"""The files of a run: parts while it goes on, one Parquet file when it is over."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from app.recording.outcome import Ending
from app.recording.parquet import write_run
from app.recording.parts import part_paths, read_parts
from app.recording.run_file import Recorded


def parquet_path(folder: Path) -> Path:
    """The file of a run that is over."""
    return folder / "run.parquet"


def convert(folder: Path, frozen: Mapping[str, Any], recorded: Recorded, ending: Ending) -> None:
    """Make the Parquet file of a run from its parts: under another name, then in one step."""
    if not part_paths(folder):
        return  # the file was made before, and the parts removed
    metadata = {
        **frozen,
        **recorded._asdict(),
        "outcome": ending.outcome.value,
        "reason": ending.reason,
    }
    write_run(parquet_path(folder), read_parts(folder), metadata)


def remove_parts(folder: Path) -> None:
    """Remove the parts of a run whose file is in place."""
    for path in part_paths(folder):
        path.unlink()
