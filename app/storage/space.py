"""What is on the disk: free space, bytes of each run, bytes of a tick."""

import os
import shutil
from pathlib import Path
from typing import NamedTuple

from rtcore.channels import TELEMETRY

PART_BYTES_PER_TICK = float(TELEMETRY.itemsize + 8)  # a part has some for each batch besides
FILE_BYTES_PER_TICK = 32.0  # of Parquet and overview, where no run has been measured yet
_LEAST_MEASURED_TICKS = 40_000


class Space(NamedTuple):
    """Of the disk that the runs are on."""

    total_bytes: int
    free_bytes: int


def space_of(folder: Path) -> Space:
    """What the console may still write there: blocks kept for the system do not count.

    Nothing where the folder cannot be asked for: no run can be recorded then.
    """
    try:
        usage = shutil.disk_usage(folder)
    except OSError:
        return Space(0, 0)
    return Space(usage.total, usage.free)


def bytes_of(folder: Path) -> int:
    """What a run's folder takes up; 0 where there is none."""
    try:
        with os.scandir(folder) as entries:
            return sum(_size(entry) for entry in entries)
    except OSError:
        return 0


def bytes_of_runs(runs_dir: Path) -> dict[int, int]:
    """What each run takes up, by its number."""
    try:
        with os.scandir(runs_dir) as entries:
            folders = [entry for entry in entries if entry.name.isdecimal()]
    except OSError:
        return {}
    return {int(folder.name): bytes_of(Path(folder.path)) for folder in folders}


def file_bytes_per_tick(run: tuple[int, int] | None) -> float:
    """Of a run of (bytes, ticks) that is over; None, or one too short to tell, as expected."""
    if run is None or run[1] < _LEAST_MEASURED_TICKS:
        return FILE_BYTES_PER_TICK
    return max(1.0, run[0] / run[1])


def _size(entry: "os.DirEntry[str]") -> int:
    try:
        return entry.stat(follow_symlinks=False).st_size
    except OSError:  # gone meanwhile
        return 0
