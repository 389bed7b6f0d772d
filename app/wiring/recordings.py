"""What the loop does, written to disk as it happens and entered as runs."""

from collections.abc import Callable
from functools import partial

from app.db import Database
from app.histories.store import Store
from app.link.life import Life
from app.recording.clerk import Clerk
from app.recording.recorder import Recorder
from app.recording.recovery import close_orphans, sweep
from app.runs.ledger import Ledger
from app.runs.measuring import measure
from app.settings import Settings


class Recordings:
    """The recorder, and the clerk who enters in the ledger what it has recorded."""

    def __init__(
        self,
        database: Database,
        settings: Settings,
        histories: Store,
        changed: Callable[[], None],
        over: Callable[[int, int], None],
    ) -> None:
        self._folder = settings.runs_dir
        measuring = partial(measure, histories=histories)
        ledger = Ledger(database, self._folder, measuring, changed, over=over)
        self._clerk = Clerk(self._folder, ledger)
        self.never_began = self._clerk.never_began
        self.recorder = Recorder(self._folder, self._clerk)

    def open(self, life: Life | None) -> None:
        """Go on with what was being recorded; what nobody can end any more is ended."""
        self._clerk.start()
        sweep(self._folder, self._clerk)
        close_orphans(self._folder, self._clerk, life.name if life else None)
        self.recorder.start()

    def close(self) -> None:
        """Write down what was recorded."""
        self.recorder.stop()
        self._clerk.stop()
