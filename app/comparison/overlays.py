"""Overlays of runs: short ones made at once, long ones in a process apart, the newest kept."""

from collections import OrderedDict
from threading import Lock

from app.comparison.computing import overlay, ticks_of
from app.comparison.order import Asked, Order, Side
from app.comparison.schemas import OverlayOut
from app.errors import Code, Refusal
from app.histories.history import Histories
from app.jobs.jobs import Job, Jobs, JobState
from app.prediction.schemas import Computing

AT_ONCE_TICKS = 2_000_000  # of all runs and channels: about a second
MOST_KEPT = 8  # who looks at settings and measurements asks for the same runs again


class Overlays:
    """Makes overlays. May be asked from any thread; who asks for the same joins the same job."""

    def __init__(self, histories: Histories | None) -> None:
        self._histories = histories
        self._jobs: Jobs[OverlayOut | Refusal] = Jobs("comparisons")
        self._under_way: dict[Asked, Job[OverlayOut | Refusal]] = {}
        self._kept: OrderedDict[Asked, OverlayOut] = OrderedDict()
        self._lock = Lock()

    def close(self) -> None:
        """Give up what is being made."""
        self._jobs.close()

    def of(
        self, asked: Asked, sides: list[Side], wait_s: float
    ) -> OverlayOut | Computing | Refusal:
        """The runs on one axis; how far that is where it takes longer than `wait_s`."""
        with self._lock:
            found = self._kept.get(asked)
            if found is not None:
                self._kept.move_to_end(asked)
                return found
        order = self._order(asked, sides)
        if ticks_of(order) <= AT_ONCE_TICKS:
            return self._keep(asked, overlay(lambda share: None, order))
        job = self._job(asked, order)
        if isinstance(job, Refusal):
            return job
        if not job.ended.wait(wait_s):
            return Computing(share=job.share, seconds_left=job.seconds_left)
        if job.state is not JobState.DONE or job.result is None:
            return job.why_not("These runs cannot be compared", Code.NO_DATA)
        return self._keep(asked, job.result)

    def _keep(self, asked: Asked, found: OverlayOut | Refusal) -> OverlayOut | Refusal:
        with self._lock:
            self._under_way.pop(asked, None)
            if isinstance(found, OverlayOut):
                self._kept[asked] = found
                while len(self._kept) > MOST_KEPT:
                    self._kept.popitem(last=False)
        return found

    def _job(self, asked: Asked, order: Order) -> Job[OverlayOut | Refusal] | Refusal:
        with self._lock:
            job = self._under_way.get(asked)
            if job is not None and job.state not in (JobState.FAILED, JobState.CANCELLED):
                return job
            title = f"Comparison of runs {', '.join(map(str, asked.ids))}"
            found = self._jobs.start(title, overlay, order)
            if isinstance(found, Job):
                self._under_way[asked] = found
            return found

    def _order(self, asked: Asked, sides: list[Side]) -> Order:
        return Order(
            tuple(sides),
            asked.channels,
            asked.align,
            asked.block,
            asked.from_s,
            asked.to_s,
            asked.points,
            asked.tolerance,
            self._histories,
        )
