"""What is made of runs: read while one is under way, and long after."""

import logging
from collections.abc import Callable

from app.comparison.service import Comparisons
from app.conducting.live import LiveResponses
from app.db import Database
from app.definitions.limits import RIG
from app.exports.service import Exports
from app.histories.store import Store
from app.link.link import Link
from app.live.broadcaster import Broadcaster
from app.reports.orders import Sources
from app.reports.service import Reports
from app.run_analysis.service import Analyses
from app.runs.predicted import RunPredictions
from app.runs.response_following import KnownRuns, teller
from app.runs.responses import Responses
from app.runs.results import Results
from app.runs.samples import RunWindows
from app.runs.service import Runs
from app.settings import Settings

_log = logging.getLogger(__name__)
LONG_TICKS = 1_000_000  # four minutes: analysed in a second or more; an hour takes some ten


class RunResults:
    """The services over the runs of a database and the folders that they were recorded in."""

    def __init__(
        self,
        database: Database,
        settings: Settings,
        histories: Store,
        link: Link,
        broadcaster: Broadcaster,
        reserved_bytes: Callable[[], int],
    ) -> None:
        folder = settings.runs_dir
        self.runs = Runs(database, folder)
        self.results = Results(database, folder, histories)
        self.windows = RunWindows(database, folder)
        self.predictions = RunPredictions(database, folder)
        self.analyses = Analyses(database, folder, histories)
        self.comparisons = Comparisons(database, folder, histories)
        self.exports = Exports(self.runs.parquet, settings.exports_dir, reserved_bytes)
        look = (settings.report_logo, settings.report_template)
        places = folder, settings.histories_dir
        self.reports = Reports(database, Sources(settings.database_address, *places, *look))
        self.live_responses = LiveResponses(
            link,
            KnownRuns(database, folder, histories),
            teller(broadcaster.tell_point),
            RIG.period_s,
        )
        self.responses = Responses(database, folder, self.live_responses, histories)

    def open(self) -> None:
        """Follow runs, and end what was being exported when the console died."""
        self.live_responses.start()
        self.exports.open()

    def run_over(self, run_id: int, ticks: int) -> None:
        """Analyse a long run before anybody asks for it, or for its report."""
        if ticks < LONG_TICKS:
            return
        try:
            self.analyses.of(run_id)
        except Exception:  # whoever wants it asks again; the run itself is written down
            _log.exception("run %d was not analysed ahead", run_id)

    def close(self) -> None:
        """End what is being computed."""
        self.analyses.close()
        self.comparisons.close()
        self.exports.close()
        self.reports.close()
        self.live_responses.close()
        self.responses.close()
