"""The overview of a run under way: rows are added as bins become complete.

The samples are written first, so no row tells of a tick that is not in the parts, unless the machine
itself went down: then nothing is added any more, and the overview is made anew when the run is filed.
"""

import logging
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from app.recording.bins import RATIOS, ROW, WIDTHS, Pyramid, Rows, columns_of
from app.recording.overview import LAYOUT, Level, rows_in
from app.recording.parts import BEGINNING, read_parts

_log = logging.getLogger(__name__)
AT_ONCE_TICKS = 4096  # gathered before bins are made: a second
MOST_MISSED_TICKS = 1 << 25  # more are not caught up with while a ring fills up


def rows_path(folder: Path, level: int) -> Path:
    """The bins of one width of a run under way."""
    return folder / f"overview-{level}.rows"


def read_live_overview(folder: Path) -> tuple[Level, ...] | None:
    """What there is of it now; None where there is none."""
    try:
        if not _is_ours(folder):
            return None
        found = [rows_in(rows_path(folder, i), len(LAYOUT)) for i in range(len(WIDTHS))]
    except (OSError, ValueError):
        return None
    return tuple(Level(w, rows, _end(rows, w)) for w, rows in zip(WIDTHS, found, strict=True))


class LiveOverview:
    """Adds to the overview of a run. Whatever fails here, the recording goes on."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._pyramid: Pyramid | None = None
        self._gathered: list[npt.NDArray[Any]] = []
        self._ticks = 0
        self._given_up = False

    def add(self, records: npt.NDArray[Any]) -> None:
        """These (n,) TELEMETRY are in the parts now."""
        if self._given_up:
            return
        self._gathered.append(records)
        self._ticks += len(records)
        if self._ticks >= AT_ONCE_TICKS:
            self._flush()

    def _flush(self) -> None:
        gathered, self._gathered, self._ticks = self._gathered, [], 0
        try:
            if self._pyramid is None:
                self._pyramid = self._resumed()
            else:
                self._write(self._pyramid.add(columns_of(np.concatenate(gathered))))
        except OSError as error:
            _log.warning("%s: no room for the overview: %s", self._folder, error)
            self._pyramid = None  # the next time, go on where the files end

    def _resumed(self) -> Pyramid | None:
        """Go on where the files end, or begin: with what is in the parts from there on."""
        levels = read_live_overview(self._folder)
        if levels is None or not _fits(levels):
            levels = tuple(Level(width, np.empty(0, ROW), 0) for width in WIDTHS)
        for i, level in enumerate(levels):
            _cut(rows_path(self._folder, i), len(level.rows))
        self._pyramid = Pyramid([_not_in_wider(levels, i) for i in range(len(RATIOS))])
        seen = 0
        for batch in read_parts(
            self._folder, verify=False, from_tick=levels[0].to_tick or BEGINNING
        ):
            seen += batch.num_rows
            if seen > MOST_MISSED_TICKS:
                self._given_up = True
                return None
            self._write(self._pyramid.add({n: batch[n].to_numpy() for n in batch.schema.names}))
        return self._pyramid

    def _write(self, found: list[Rows]) -> None:
        for i, rows in enumerate(found):  # finest first: a wider bin is never ahead
            if len(rows):
                with rows_path(self._folder, i).open("ab", buffering=0) as file:
                    _write_whole(file, rows.tobytes())


def _write_whole(file: Any, content: bytes) -> None:
    rest = memoryview(content)
    while rest:
        rest = rest[file.write(rest) :]


def _is_ours(folder: Path) -> bool:
    for i in range(len(WIDTHS)):
        with rows_path(folder, i).open("rb") as file:
            if file.read(len(LAYOUT)) != LAYOUT:
                return False
    return True


def _end(rows: Rows, width: int) -> int:
    return (int(rows["bin"][-1]) + 1) * width if len(rows) else 0


def _fits(levels: tuple[Level, ...]) -> bool:
    """Whether the bins ascend, and none is ahead of the finer ones."""
    rising = all(bool(np.all(np.diff(level.rows["bin"]) > 0)) for level in levels)
    return rising and all(level.to_tick <= levels[0].to_tick for level in levels)


def _not_in_wider(levels: tuple[Level, ...], i: int) -> Rows:
    rows = levels[i].rows
    return np.array(rows[int(np.searchsorted(rows["bin"] * WIDTHS[i], levels[i + 1].to_tick)) :])


def _cut(path: Path, rows: int) -> None:
    """Leave the header and so many rows, or begin a new file: a reader may have mapped the old one."""
    if rows == 0:
        path.unlink(missing_ok=True)
    with path.open("ab", buffering=0) as file:
        if rows == 0:
            _write_whole(file, LAYOUT)
        file.truncate(len(LAYOUT) + rows * ROW.itemsize)
