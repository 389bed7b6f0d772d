"""The files of the black boxes: one Parquet file each, whole under its name or not there.

A box is written beside its place first, with all that the database is to know of it; entering it moves it into
its folder. So whatever is killed in between, the next start finds the box and enters it.
"""

import logging
from collections.abc import Iterator, Sequence
from pathlib import Path

import pyarrow.parquet as pq

from app.first_outs.account import Account
from app.first_outs.box import Box
from app.recording.bins import Columns
from app.recording.columns import as_batch
from app.recording.parquet import read_metadata, write_run
from app.recording.samples import Levels, ParquetSamples
from app.recording.whole_file import remove_temporaries, sync_folder

_log = logging.getLogger(__name__)
_WAITING = "waiting-*.parquet"


class BoxSamples:
    """The samples of a black box: so few that they need no overview."""

    def __init__(self, path: Path) -> None:
        self._file = ParquetSamples(path)
        self.first_tick = self._file.first_tick
        self.last_tick = self._file.last_tick

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        """As of any recorded samples."""
        yield from self._file.chunks(names, first_tick, last_tick)

    def levels(self) -> Levels:
        return ()


def box_path(folder: Path, number: int) -> Path:
    """The file of a first-out that is entered."""
    return folder / str(number) / "box.parquet"


def set_down(folder: Path, box: Box) -> Path:
    """Write a box that waits to be entered. Raises `OSError`."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"waiting-{box.account.loop_life}-{box.account.tick}.parquet"
    batches = [as_batch(box.records)] if len(box.records) else []
    write_run(path, batches, box.account.model_dump(mode="json"))
    return path


def account_in(path: Path) -> Account:
    """What a box says of itself. Raises `OSError`, `ValueError`."""
    return Account.model_validate(read_metadata(path))


def put_in_place(waiting: Path, folder: Path, number: int) -> None:
    """Move a box that waits into its folder. Raises `OSError`."""
    path = box_path(folder, number)
    path.parent.mkdir(exist_ok=True)
    waiting.replace(path)
    sync_folder(path.parent)


def take_out(folder: Path, number: int) -> None:
    """Remove the box of a first-out that is in no book any more."""
    path = box_path(folder, number)
    path.unlink(missing_ok=True)
    if path.parent.exists():
        path.parent.rmdir()


def waiting_boxes(folder: Path) -> list[Path]:
    """The boxes that wait to be entered, in the order in which they tripped."""
    found = []
    for path in folder.glob(_WAITING):
        try:
            account = account_in(path)
        except (OSError, ValueError):
            _log.exception("%s is no black box: it is left alone", path.name)
            continue
        found.append((account.tripped_at, account.tick, path))
    return [path for *_, path in sorted(found)]


def give_back(folder: Path, known: set[int]) -> None:
    """After a kill: boxes in folders that no first-out in the book has wait to be entered again."""
    if not folder.is_dir():
        return
    remove_temporaries(folder)
    for place in folder.iterdir():
        if not place.name.isdecimal() or int(place.name) in known:
            continue
        path = box_path(folder, int(place.name))
        if path.exists():
            path.replace(folder / f"waiting-{place.name}-again.parquet")
        place.rmdir()


def samples_of(folder: Path, number: int) -> BoxSamples | None:
    """The samples of a first-out; None where nothing was left of it in the ring."""
    path = box_path(folder, number)
    try:
        return BoxSamples(path) if pq.read_metadata(path).num_rows else None
    except FileNotFoundError:
        return None
