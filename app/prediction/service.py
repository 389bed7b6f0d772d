"""Predictions of this console: computed beside everything else, each once, and kept for who asks again."""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.errors import Code, Refusal
from app.interlocks.table import Interlocks
from app.prediction.key import key_of
from app.prediction.play import Progress
from app.prediction.predicting import Predicted, predict
from app.prediction.schemas import Computing
from app.prediction.setup import Setup
from rtcore.rig.parameters import RigParameters

WORKERS = 2  # so that one of a day's test does not keep the others waiting
MOST_KEPT_BYTES = 100_000_000  # of force and displacement; the newest is kept whatever it takes
LEAST_SHARE = 0.02  # before that nothing can be said of the time that is left
ENDING = Refusal(Code.BUSY, "The console is being ended: the prediction was given up")

Predictor = Callable[[Setup, Progress], Predicted]


class _Ended(Exception):
    """The console ends: there is nobody to predict for."""


@dataclass(frozen=True)
class _InForce:
    """What it predicts with: replaced whole, so that no prediction is made with half of each."""

    controller: ControllerSettings
    interlocks: Interlocks
    rig: RigParameters


@dataclass
class _Job:
    future: "Future[Predicted]" = field(default_factory=Future)
    began_s: float | None = None
    share: float = 0.0

    def computing(self) -> Computing:
        """How far it is."""
        if self.began_s is None or self.share < LEAST_SHARE:
            return Computing(share=self.share, seconds_left=None)
        spent_s = time.monotonic() - self.began_s
        return Computing(share=self.share, seconds_left=spent_s * (1 / self.share - 1))


class Predictions:
    """Predicts with the console's own controller, interlocks and rig."""

    def __init__(
        self,
        controller: ControllerSettings,
        interlocks: Interlocks,
        rig: RigParameters,
        predictor: Predictor = predict,
    ) -> None:
        self._in_force = _InForce(controller, interlocks, rig)
        self._predict = predictor
        # At the priority of the console's other threads: one that is put off by other work while it
        # holds the interpreter's lock puts off the heartbeat too.
        self._workers = ThreadPoolExecutor(WORKERS, "prediction")
        self._draft_worker = ThreadPoolExecutor(1, "draft")  # starts do not queue behind drafts
        self._jobs: dict[str, _Job] = {}
        self._kept: OrderedDict[str, Predicted] = OrderedDict()
        self._lock = threading.Lock()
        self._ending = threading.Event()

    def turn_to(
        self,
        *,
        controller: ControllerSettings | None = None,
        interlocks: Interlocks | None = None,
        rig: RigParameters | None = None,
    ) -> None:
        """Predict with these from now on; what is left out stays."""
        now = self._in_force
        self._in_force = _InForce(
            controller or now.controller, interlocks or now.interlocks, rig or now.rig
        )

    def stands(self, definition: Definition, predicted: Predicted) -> bool:
        """Whether a prediction was made with what is in force now."""
        return predicted.prediction.key == key_of(self._setup(definition))

    def _setup(self, definition: Definition) -> Setup:
        now = self._in_force
        return Setup(definition, now.rig, now.controller, now.interlocks)

    def of(
        self, definition: Definition, wait_s: float, *, draft: bool = False
    ) -> Predicted | Computing | Refusal:
        """The prediction of a test, or how far it is after waiting so long.

        Whoever asks for the same joins the same computation; who asks for another one cancels nothing.
        A draft is a test that cannot be started: it is not saved.
        """
        setup = self._setup(definition)
        key = key_of(setup)
        with self._lock:
            known = self._kept.get(key)
            if known is not None:
                self._kept.move_to_end(key)
                return known
            if self._ending.is_set():
                return ENDING
            job = self._jobs.get(key)
            if job is None:
                job = self._jobs[key] = _Job()
                workers = self._draft_worker if draft else self._workers
                workers.submit(self._compute, key, setup, job)
        wait([job.future], wait_s)
        if not job.future.done():
            return job.computing()
        error = job.future.exception()
        return ENDING if isinstance(error, _Ended) else job.future.result()

    def warm_up(self) -> None:
        """Compile what predicts, where that is not done yet: the first to ask would wait for it."""
        block = {"kind": "hold", "duration_s": 0.01}
        data = {"schema": 1, "name": "warm-up", "blocks": [block]}
        self.of(Definition.model_validate(data), 0.0)

    def close(self) -> None:
        """Give up what is being computed: nobody is there any more to ask for it."""
        self._ending.set()
        self._workers.shutdown()
        self._draft_worker.shutdown()

    def _compute(self, key: str, setup: Setup, job: _Job) -> None:
        job.began_s = time.monotonic()

        def progress(share: float) -> None:
            if self._ending.is_set():
                raise _Ended
            job.share = share

        try:
            progress(0.0)
            found = self._predict(setup, progress)
        except BaseException as error:
            with self._lock:
                del self._jobs[key]
            job.future.set_exception(error)
            return
        with self._lock:
            self._keep(key, found)
            del self._jobs[key]
        job.future.set_result(found)

    def _keep(self, key: str, found: Predicted) -> None:
        self._kept[key] = found
        while len(self._kept) > 1 and sum(p.nbytes for p in self._kept.values()) > MOST_KEPT_BYTES:
            self._kept.popitem(last=False)
