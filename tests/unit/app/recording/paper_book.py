"""A book of runs on paper: what the clerk was told, for the tests to look at."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow.parquet as pq

from app.link.events import LoopEvent
from app.recording.clerk import Clerk, OpenRun
from app.recording.outcome import Ending
from app.recording.parts import part_paths
from app.recording.run_file import Recorded
from app.recording.tape import Tape
from tests.written_block import WrittenBlock


class PaperBook:
    """Keeps what it is told."""

    def __init__(self) -> None:
        self.open: dict[int, OpenRun] = {}
        self.events: dict[int, dict[int, LoopEvent]] = {}
        self.ends: dict[int, tuple[Recorded, Ending]] = {}
        self.ended_in_order: list[int] = []

    def enter(self, run_id: int, first_tick: int | None = None, life: str = "1-42") -> None:
        """A run is about to start."""
        self.open[run_id] = OpenRun(run_id, first_tick, life)

    def open_runs(self) -> Sequence[OpenRun]:
        return list(self.open.values())

    def began(self, run_id: int, first_tick: int) -> None:
        if run_id in self.open and self.open[run_id].first_tick is None:
            self.open[run_id] = self.open[run_id]._replace(first_tick=first_tick)

    def reported(self, run_id: int, events: Sequence[LoopEvent]) -> None:
        known = self.events.setdefault(run_id, {})
        for event in events:
            known.setdefault(event.sequence, event)

    def ended(self, run_id: int, recorded: Recorded, ending: Ending) -> None:
        self.ended_in_order.append(run_id)
        self.ends[run_id] = (recorded, ending)
        self.open.pop(run_id, None)

    def frozen(self, run_id: int) -> dict[str, Any]:
        return {"run_id": run_id}

    def kinds(self, run_id: int) -> list[str]:
        """The kinds of a run's events, in order."""
        return [event.kind for _, event in sorted(self.events.get(run_id, {}).items())]


class Desk:
    """A recorder's tape and clerk over a book, without threads: `drain` does all there is to do."""

    def __init__(self, written: WrittenBlock, folder: Path, book: PaperBook) -> None:
        self.folder = folder
        self.book = book
        self._clerk = Clerk(folder, book)
        self.tape = Tape(written.life(), folder, self._clerk)

    def drain(self) -> None:
        """Read what is published, and write it down."""
        self.tape.drain()
        self._clerk.work_off()

    def kill(self) -> None:
        """Leave the files as a kill would: the stream of the present part has no end."""
        file = self.tape.current
        if file is not None:
            unended = {path: path.read_bytes() for path in part_paths(file.folder)}
            file.abandon_part()
            for path, content in unended.items():
                path.write_bytes(content)

    def finish(self) -> None:
        """The loop has died."""
        self.tape.drain()
        self.tape.finish()
        self._clerk.work_off()

    def end_unseen(self) -> None:
        """The first drain is over."""
        self.tape.end_unseen()
        self._clerk.work_off()


def recorded_ticks(folder: Path, run_id: int) -> npt.NDArray[np.int64]:
    """The ticks in the file of a run."""
    table = pq.read_table(folder / str(run_id) / "run.parquet")
    ticks: npt.NDArray[np.int64] = table["tick"].to_numpy()
    assert np.array_equal(table["force_n"].to_numpy(), ticks.astype(np.float32))
    return ticks
