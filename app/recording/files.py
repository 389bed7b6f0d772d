"""The files of a run: parts while it goes on, one Parquet file and an overview when it is over."""

import logging
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Any

from app.recording.bins import Columns
from app.recording.columns import whole_columns
from app.recording.extent import Extent
from app.recording.outcome import Ending
from app.recording.overview import write_overview
from app.recording.parquet import row_groups, write_run
from app.recording.parts import part_paths, read_parts
from app.recording.run_file import STOPPED_BECAUSE, Recorded

_log = logging.getLogger(__name__)
_OF_A_RUN_UNDER_WAY = ("part-*.arrows", "part-*.index", "overview-*.rows", STOPPED_BECAUSE)
_OF_EVERY_TICK = ("run.parquet", "overview-*.bin", "predicted.parquet", "part-*.damaged")


def parquet_path(folder: Path) -> Path:
    """The file of a run that is over."""
    return folder / "run.parquet"


def convert(
    folder: Path, frozen: Mapping[str, Any], recorded: Recorded, ending: Ending
) -> Recorded:
    """Make the Parquet file of a run from its parts: under another name, then in one step.

    Each batch is verified on the way. Returns what is in the file: `recorded`, unless the disk did
    not keep what it was given. Raises `OSError`.
    """
    if not part_paths(folder):
        return recorded  # the file was made before, and the parts removed
    passing = _Passing(read_parts(folder))
    how = {"outcome": ending.outcome.value, "reason": ending.reason}

    def described() -> dict[str, Any]:
        return {**frozen, **_kept(recorded, passing.extent)._asdict(), **how}

    batches = iter(passing)
    first = next(batches, None)
    if first is not None:
        whole = with_overview(folder, chain([first], batches))
        write_run(parquet_path(folder), whole, described)
    kept = _kept(recorded, passing.extent)
    if kept != recorded:
        text = "%s: %d of %d recorded ticks can be read back; the parts are kept as they are"
        _log.error(text, folder, kept.ticks, recorded.ticks)
    return kept


def with_overview(folder: Path, batches: Iterable[Any]) -> Iterator[Any]:
    """Pass batches on in larger pieces, and make the overview of them on the way."""
    pieces: list[Any] = []

    def chunks() -> Iterator[Columns]:
        for table in row_groups(batches):
            pieces.extend(table.to_batches())
            yield whole_columns(table)

    for _ in write_overview(folder, chunks()):
        yield from pieces
        pieces.clear()


def remove_parts(folder: Path) -> None:
    """Remove the parts of a run whose file is in place, and what was made of them."""
    _remove(folder, _OF_A_RUN_UNDER_WAY)


def remove_samples(folder: Path) -> None:
    """Remove all that a run that is over has of every tick; what was reduced of it stays."""
    _remove(folder, (*_OF_EVERY_TICK, *_OF_A_RUN_UNDER_WAY))


def _remove(folder: Path, patterns: Iterable[str]) -> None:
    for pattern in patterns:
        for path in folder.glob(pattern):
            path.unlink(missing_ok=True)


def keep_parts(folder: Path) -> None:
    """Put the parts of a run out of the way: not all of them could be read."""
    for path in part_paths(folder):
        path.rename(path.with_name(f"{path.name}.damaged"))
    remove_parts(folder)


class _Passing:
    """Batches that are counted as they pass."""

    def __init__(self, batches: Iterable[Any]) -> None:
        self._batches = batches
        self.extent = Extent()

    def __iter__(self) -> Iterator[Any]:
        for batch in self._batches:
            self.extent = self.extent.grown_by(batch.column("tick").to_numpy())
            yield batch


def _kept(recorded: Recorded, extent: Extent) -> Recorded:
    if extent.ticks == recorded.ticks:
        return recorded
    expected = recorded.last_tick - recorded.first_tick + 1
    return recorded._replace(ticks=extent.ticks, missing_ticks=expected - extent.ticks)
