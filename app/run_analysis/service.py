"""The analyses of the runs: kept in their folders, computed where one is missing."""

import logging
from pathlib import Path
from threading import Lock

from app.db import Database
from app.errors import Code, Refusal
from app.histories.history import Histories
from app.jobs.jobs import Job, Jobs, JobState
from app.prediction.schemas import Computing
from app.recording.samples import open_samples
from app.run_analysis.computing import Subject, analyse_run, kept
from app.run_analysis.schemas import BEFORE, RunAnalysis
from app.runs import repository
from app.runs.no_data import no_data

_log = logging.getLogger(__name__)


class Analyses:
    """The analysis of each run of this data directory. May be asked from any thread."""

    def __init__(
        self, database: Database, runs_dir: Path, histories: Histories | None = None
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._histories = histories
        self._jobs: Jobs[None] = Jobs("analyses")
        self._of_run: dict[int, Job[None]] = {}
        self._lock = Lock()

    def of(self, run_id: int, wait_s: float = 0.0) -> RunAnalysis | Computing | Refusal:
        """The analysis of a run that is over; how far it is where that takes longer than `wait_s`."""
        subject = self._subject(run_id)
        if isinstance(subject, Refusal):
            return subject
        found = kept(subject.folder) or self._outlived(run_id, subject.folder)
        if found is not None:
            return found
        refusal = self._without_samples(run_id, subject)
        job = refusal or self._job(run_id, subject)
        if isinstance(job, Refusal):
            return job
        if not job.ended.wait(wait_s):
            return Computing(share=job.share, seconds_left=job.seconds_left)
        return self._outcome(run_id, subject.folder, job)

    def close(self) -> None:
        """Give up what is being computed."""
        self._jobs.close()

    def _job(self, run_id: int, subject: Subject) -> Job[None] | Refusal:
        """The computation of a run: that which is under way, or a new one."""
        with self._lock:
            job = self._of_run.get(run_id)
            if job is not None and not job.ended.is_set():
                return job
            found = self._jobs.start(f"Analysis of run {run_id}", analyse_run, subject)
            if isinstance(found, Job):
                self._of_run = {n: j for n, j in self._of_run.items() if not j.ended.is_set()}
                self._of_run[run_id] = found
            return found

    def _outcome(self, run_id: int, folder: Path, job: Job[None]) -> RunAnalysis | Refusal:
        found = kept(folder) if job.state is JobState.DONE else None
        if found is not None:
            return found
        _log.warning("run %d was not analysed: %s", run_id, job.reason)
        return job.why_not(f"Run {run_id} was not analysed", Code.NO_DATA)

    def _outlived(self, run_id: int, folder: Path) -> RunAnalysis | None:
        """One of the version before, where it is right: of a run without samples there will be no other."""
        found = kept(folder, BEFORE)
        if found is None or open_samples(folder) is not None:
            return None
        with self._database.reading() as session:
            skipped = any(e.kind == "skipped" for e in repository.events(session, run_id))
        return None if skipped else found

    def _without_samples(self, run_id: int, subject: Subject) -> Refusal | None:
        if open_samples(subject.folder) is not None:
            return None
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            return None if run is None else no_data(run)

    def _subject(self, run_id: int) -> Subject | Refusal:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
            if run.outcome is None:
                detail = f"Run {run_id} is still under way: it is analysed once it is over"
                return Refusal(Code.RUN_UNDER_WAY, detail)
            return Subject(
                folder=self._runs_dir / str(run_id),
                definition=run.definition,
                rig=run.rig,
                period_s=run.period_ns * 1e-9,
                first_tick=run.first_tick,
                histories=self._histories,
            )
