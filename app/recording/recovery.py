"""After a restart: runs whose loop is gone get their end, left-over parts of finished runs go."""

from pathlib import Path

from app.recording.clerk import Clerk, OpenRun
from app.recording.extent import extent_of
from app.recording.files import parquet_path, remove_parts
from app.recording.outcome import LOOP_ENDED, NEVER_BEGAN, Ending, Outcome
from app.recording.parquet import read_metadata
from app.recording.run_file import Recorded
from app.recording.whole_file import remove_temporaries


def close_orphans(runs_dir: Path, clerk: Clerk, living: str | None) -> None:
    """End the runs of every life of the loop but this one: nothing will be added to them."""
    for run in clerk.open_runs(None):
        if run.loop_life != living:
            clerk.ended(run.id, *_end_of(runs_dir / str(run.id), run))


def _end_of(folder: Path, run: OpenRun) -> tuple[Recorded, Ending]:
    if parquet_path(folder).exists():  # it had ended: only the book had not heard of it
        return _end_in_file(parquet_path(folder))
    extent = extent_of(folder)
    if extent.ticks == 0:
        ending = NEVER_BEGAN if run.first_tick is None else LOOP_ENDED
        return Recorded(-1, -1, 0, 0), ending
    first = extent.first_tick if run.first_tick is None else run.first_tick
    missing = extent.last_tick - first + 1 - extent.ticks
    return Recorded(first, extent.last_tick, extent.ticks, missing), LOOP_ENDED


def _end_in_file(path: Path) -> tuple[Recorded, Ending]:
    told = read_metadata(path)
    recorded = Recorded(*(int(told[name]) for name in Recorded._fields))
    return recorded, Ending(Outcome(told["outcome"]), told["reason"])


def sweep(runs_dir: Path, clerk: Clerk) -> None:
    """Remove what kills left: parts of runs that are over and have their file, unfinished files."""
    open_runs = {str(run.id) for run in clerk.open_runs(None)}
    for folder in runs_dir.iterdir():
        if not folder.is_dir():
            continue
        remove_temporaries(folder)
        if folder.name not in open_runs and parquet_path(folder).exists():
            remove_parts(folder)
