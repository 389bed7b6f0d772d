"""What whoever follows a run under way has to know of it, and how its points are told."""

from collections.abc import Callable, Hashable, Iterator
from pathlib import Path

from app.conducting.found import Found
from app.conducting.live import Known
from app.conducting.responding import NEEDS, responds
from app.db import Database
from app.histories.history import Histories
from app.recording.bins import Columns
from app.recording.samples import open_samples
from app.runs import repository
from app.runs.measuring import read_definition, read_rig
from app.runs.response_series import frame_of


class KnownRuns:
    """The tests of runs by their numbers, where they have a frequency response."""

    def __init__(self, database: Database, runs_dir: Path, histories: Histories | None) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._histories = histories

    def __call__(self, run_id: int) -> Known | None:
        """Raises `ValueError` where its test cannot be read."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return None
            written, rig = run.definition, run.rig
        definition = read_definition(written, self._histories)
        folder = self._runs_dir / str(run_id)
        if not responds(definition):
            return None
        return Known(definition, read_rig(rig), lambda tick: _recorded(folder, tick))


def _recorded(folder: Path, before_tick: int) -> Iterator[Columns]:
    samples = open_samples(folder)
    if samples is not None:
        yield from samples.chunks(NEEDS, samples.first_tick, before_tick - 1)


def teller(put: Callable[[Hashable, str], None]) -> Callable[[int, Found], None]:
    """Tells points as frames of the live stream; those of one point replace one another."""

    def tell(run_id: int, found: Found) -> None:
        key = (run_id, found.method, found.point.transfer, *found.point[1:5])
        put(key, frame_of(run_id, found).model_dump_json())

    return tell
