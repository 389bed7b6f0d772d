"""After a restart: runs whose loop is gone get their end, left-over parts of finished runs go."""

from pathlib import Path

from app.recording.clerk import Clerk
from app.recording.extent import extent_of
from app.recording.files import parquet_path, remove_parts
from app.recording.outcome import LOOP_ENDED, NEVER_BEGAN
from app.recording.run_file import Recorded


def close_orphans(runs_dir: Path, clerk: Clerk, living: str | None) -> None:
    """End the runs of every life of the loop but this one: nothing will be added to them."""
    for run in clerk.open_runs(None):
        if run.loop_life == living:
            continue
        extent = extent_of(runs_dir / str(run.id))
        if extent.ticks == 0:
            ending = NEVER_BEGAN if run.first_tick is None else LOOP_ENDED
            clerk.ended(run.id, Recorded(-1, -1, 0, 0), ending)
            continue
        first = extent.first_tick if run.first_tick is None else run.first_tick
        missing = extent.last_tick - first + 1 - extent.ticks
        recorded = Recorded(first, extent.last_tick, extent.ticks, missing)
        clerk.ended(run.id, recorded, LOOP_ENDED)


def sweep(runs_dir: Path, clerk: Clerk) -> None:
    """Remove the parts of runs that are over and have their file: a kill came between the two."""
    open_runs = {str(run.id) for run in clerk.open_runs(None)}
    for folder in runs_dir.iterdir():
        if folder.name not in open_runs and parquet_path(folder).exists():
            remove_parts(folder)
