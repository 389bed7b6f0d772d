"""Re-runs: computed one at a time by a worker of their own, each once, and kept for who asks again."""

import json
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from typing import NamedTuple

from app.definitions.definition import Definition
from app.errors import Code, Refusal
from app.first_outs.account import Account
from app.first_outs.changes import Changed, InForceThen, change, settings_then
from app.first_outs.rerunning import CannotRerun, Played, play
from app.first_outs.scene import Scene, scene_of
from app.prediction.schemas import Computing

MOST_KEPT = 8
MOST_WAITING = 4
LEAST_SHARE = 0.02  # before that nothing can be said of the time that is left
_ENDING = Refusal(Code.BUSY, "The console is being ended: the re-run was given up")
_BUSY = Refusal(Code.BUSY, "Other re-runs are being computed: try again once they are done")

DefinitionOf = Callable[[int], Definition | Refusal]  # of a run, by its number


class Rerun(NamedTuple):
    """A first-out played without and with a change."""

    made: Changed
    scene: Scene
    unchanged: Played
    changed: Played


class _Ended(Exception):
    """The console ends: there is nobody to play for."""


@dataclass
class _Job:
    future: "Future[Rerun | Refusal]" = field(default_factory=Future)
    began_s: float | None = None
    share: float = 0.0

    def computing(self) -> Computing:
        """How far it is."""
        if self.began_s is None or self.share < LEAST_SHARE:
            return Computing(share=self.share, seconds_left=None)
        spent_s = time.monotonic() - self.began_s
        return Computing(share=self.share, seconds_left=spent_s * (1 / self.share - 1))


class Reruns:
    """Plays first-outs again. Who asks for the same joins the same computation."""

    def __init__(self, definition_of: DefinitionOf) -> None:
        self._definition_of = definition_of
        self._worker = ThreadPoolExecutor(1, "rerun")  # no start's prediction queues behind it
        self._jobs: dict[str, _Job] = {}
        self._kept: OrderedDict[str, Rerun] = OrderedDict()
        self._lock = threading.Lock()
        self._ending = threading.Event()

    def of(
        self, number: int, account: Account, path: str, value: object, wait_s: float
    ) -> Rerun | Computing | Refusal:
        """A first-out with the value at a path changed, or how far it is after waiting so long."""
        then = settings_then(account.settings)
        if isinstance(then, Refusal):
            return then
        made = change(then, path, value)
        if isinstance(made, Refusal):
            return made
        key = json.dumps([number, path, value])
        with self._lock:
            known = self._kept.get(key)
            if known is not None:
                self._kept.move_to_end(key)
                return known
            job = self._jobs.get(key)
            if job is None:
                if self._ending.is_set() or len(self._jobs) >= MOST_WAITING:
                    return _ENDING if self._ending.is_set() else _BUSY
                job = self._jobs[key] = _Job()
                self._worker.submit(self._compute, key, account, then, made, job)
        wait([job.future], wait_s)
        if not job.future.done():
            return job.computing()
        return _ENDING if isinstance(job.future.exception(), _Ended) else job.future.result()

    def close(self) -> None:
        """Give up what is being computed."""
        self._ending.set()
        self._worker.shutdown()

    def _compute(
        self, key: str, account: Account, then: InForceThen, made: Changed, job: _Job
    ) -> None:
        job.began_s = time.monotonic()
        try:
            found = self._played(account, then, made, job)
        except BaseException as error:
            with self._lock:
                del self._jobs[key]
            job.future.set_exception(error)
            return
        with self._lock:
            if isinstance(found, Rerun):
                self._kept[key] = found
                while len(self._kept) > MOST_KEPT:
                    self._kept.popitem(last=False)
            del self._jobs[key]
        job.future.set_result(found)

    def _played(
        self, account: Account, then: InForceThen, made: Changed, job: _Job
    ) -> Rerun | Refusal:
        test = None if account.run_id is None else self._definition_of(account.run_id)
        if isinstance(test, Refusal):
            return test
        scene = scene_of(account, test)
        try:
            unchanged = play(scene, then, self._progress(job, 0.0))
            changed = play(scene, made.settings, self._progress(job, 0.5))
        except CannotRerun as error:
            return Refusal(Code.INVALID_REQUEST, f"The virtual rig does not get there: {error}")
        return Rerun(made, scene, unchanged, changed)

    def _progress(self, job: _Job, done: float) -> Callable[[float], None]:
        def progress(share: float) -> None:
            if self._ending.is_set():
                raise _Ended
            job.share = done + 0.5 * share

        return progress
