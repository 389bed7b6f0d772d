"""The jobs of one feature: each waits for its turn, is worked on in a process apart, and is kept for a while."""

import logging
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from datetime import UTC, datetime
from enum import StrEnum
from secrets import token_hex
from typing import Any, Generic, TypeVar

from app.errors import Code, Refusal
from app.jobs.apart import BrokeOff, GivenUp, WorkFailed, run_apart

MOST_WAITING = 8
MOST_KEPT = 32
LEAST_SHARE = 0.02  # before that nothing can be said of the time that is left
T = TypeVar("T")
_log = logging.getLogger(__name__)


class JobState(StrEnum):
    """Where a job is."""

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"


@dataclass
class Job(Generic[T]):
    """Some long work, how far it is, and what came of it; `reason` says why nothing did.

    `broke_off` where its process died.
    """

    title: str
    id: str = field(default_factory=lambda: token_hex(8))
    made_at: datetime = field(default_factory=lambda: datetime.now(UTC))
    state: JobState = JobState.WAITING
    share: float = 0.0
    began_s: float | None = None
    result: T | None = None
    reason: str | None = None
    broke_off: bool = False
    unwanted: threading.Event = field(default_factory=threading.Event)
    ended: threading.Event = field(default_factory=threading.Event)

    @property
    def seconds_left(self) -> float | None:
        """None where nothing can be said yet."""
        if self.state is not JobState.RUNNING or self.began_s is None or self.share < LEAST_SHARE:
            return None
        return (time.monotonic() - self.began_s) * (1 / self.share - 1)

    def report(self, share: float) -> None:
        """The share that is done, 0…1."""
        self.share = share

    def why_not(self, sentence: str, code: Code) -> Refusal:
        """Why nothing came of it; `code` says so where its process lived to the end."""
        return Refusal(Code.BROKE_OFF if self.broke_off else code, f"{sentence}. {self.reason}")


class Jobs(Generic[T]):
    """Starts jobs and knows them by their ids. From any thread."""

    def __init__(self, name: str, workers: int = 1) -> None:
        self._workers = ThreadPoolExecutor(workers, name)
        self._jobs: OrderedDict[str, Job[T]] = OrderedDict()
        self._lock = threading.Lock()
        self._ending = False

    def start(
        self,
        title: str,
        work: Callable[..., T],
        *arguments: Any,
        then: Callable[[T], T] | None = None,
    ) -> Job[T] | Refusal:
        """Have `work(report, *arguments)` done in a process apart; `then` takes over what it gave, in this one."""
        job: Job[T] = Job(title)
        with self._lock:
            waiting = [j for j in self._jobs.values() if j.state is JobState.WAITING]
            if self._ending or len(waiting) >= MOST_WAITING:
                why = "the console is being ended" if self._ending else "too many are waiting"
                return Refusal(Code.BUSY, f"{title}: {why}; try again later")
            self._jobs[job.id] = job
            self._forget()
            self._workers.submit(self._carry_out, job, work, arguments, then)
        return job

    def get(self, job_id: str) -> Job[T] | Refusal:
        """A job by its id."""
        with self._lock:
            found = self._jobs.get(job_id)
        return found or Refusal(Code.NOT_FOUND, f"There is no job {job_id}: it may be too old")

    def all(self) -> list[Job[T]]:
        """Those that are known, the newest first."""
        with self._lock:
            return list(reversed(self._jobs.values()))

    def cancel(self, job_id: str) -> Job[T] | Refusal:
        """Give a job up; one that has ended stays as it is."""
        job = self.get(job_id)
        if isinstance(job, Job):
            job.unwanted.set()
        return job

    def close(self) -> None:
        """Give all of them up."""
        with self._lock:
            self._ending = True
            jobs = list(self._jobs.values())
        for job in jobs:
            job.unwanted.set()
        self._workers.shutdown()

    def _forget(self) -> None:
        ended = [job.id for job in self._jobs.values() if job.ended.is_set()]
        for job_id in ended[: max(0, len(self._jobs) - MOST_KEPT)]:
            del self._jobs[job_id]

    def _carry_out(
        self,
        job: Job[T],
        work: Callable[..., T],
        arguments: tuple[Any, ...],
        then: Callable[[T], T] | None,
    ) -> None:
        job.began_s, job.state = time.monotonic(), JobState.RUNNING
        try:
            if job.unwanted.is_set():
                raise GivenUp
            found = run_apart(work, *arguments, report=job.report, unwanted=job.unwanted)
            job.result = found if then is None else then(found)
            job.share, job.state = 1.0, JobState.DONE
        except GivenUp:
            job.state, job.reason = JobState.CANCELLED, "It was given up"
        except WorkFailed as error:
            job.state, job.reason = JobState.FAILED, str(error)
            job.broke_off = isinstance(error, BrokeOff)
        except Exception as error:
            _log.exception("%s", job.title)
            job.state, job.reason = JobState.FAILED, str(error)
        finally:
            job.ended.set()
