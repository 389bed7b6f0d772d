"""Follows the run under way beside the recorder: its frequency responses so far, and what of it is left out.

Where this thread dies, or whoever started the test is not in command any more, the test plays its full length.
"""

import logging
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from threading import Event, Lock, Thread
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from app.conducting.conducting import Conducting
from app.conducting.found import Found
from app.definitions.definition import Definition
from app.errors import Code, Refusal
from app.link.commander import Answer
from app.link.life import Life, RingReader
from app.recording.bins import Columns
from rtcore.codes import Opcode
from rtcore.rig.parameters import RigParameters

_log = logging.getLogger(__name__)
LOOK_S = 0.02
IDLE_S = 0.1  # while no run has a frequency response
TELL_S = 0.1  # between two looks at which points have changed
MOST_TICKS = 4000  # of a look: a second
Records = npt.NDArray[Any]


class Loop(Protocol):
    """What is asked of the link."""

    @property
    def life(self) -> Life | None: ...

    def ask(
        self, opcode: Opcode, argument: int = 0, *, value: float = 0.0, lease: int | None = None
    ) -> Answer | Refusal: ...


class Known(NamedTuple):
    """A run that has a frequency response, the rig's model, and the ticks that are on the disk before one."""

    definition: Definition
    rig: RigParameters | None
    recorded: Callable[[int], Iterator[Columns]]


@dataclass
class _Run:
    """A run that is followed. `epoch` is that under which it was started."""

    id: int
    conducting: Conducting
    epoch: int
    conducts: bool
    quiet_until: int = -1  # the tick of the last skip
    told: dict[tuple[object, ...], tuple[int, bool]] = field(default_factory=dict)


class LiveResponses:
    """A thread that reads the ring; its points may be asked for from any other."""

    def __init__(
        self,
        loop: Loop,
        known: Callable[[int], Known | None],
        tell: Callable[[int, Found], None],
        period_s: float,
    ) -> None:
        """`known` gives the test of a run where it has a frequency response; `tell` is called for each new point."""
        self._loop = loop
        self._known = known
        self._tell = tell
        self._period_s = period_s
        self._life: Life | None = None
        self._reader: RingReader | None = None
        self._run_id = 0  # that of the latest record
        self._run: _Run | None = None
        self._lock = Lock()
        self._ended = Event()
        self._thread = Thread(target=self._follow, name="live-responses", daemon=True)

    def start(self) -> None:
        """Begin to follow."""
        self._thread.start()

    def close(self) -> None:
        """Follow no more."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def points(self, run_id: int) -> list[Found]:
        """The points of a run so far; none of one that is not followed."""
        with self._lock:
            run = self._run
            return run.conducting.responding.points() if run and run.id == run_id else []

    def progress(self, run_id: int) -> tuple[int, int, float | None] | None:
        """Points so far, of how many expected, and seconds left; None of a run that is not followed."""
        with self._lock:
            run = self._run
            return run.conducting.progress() if run and run.id == run_id else None

    def _follow(self) -> None:
        looks = 0
        while not self._ended.wait(IDLE_S if self._run is None else LOOK_S):
            try:
                self.look()
                looks += 1
                if looks * LOOK_S >= TELL_S:
                    looks = 0
                    self.tell()
            except Exception:  # the test goes on by itself
                _log.exception("the frequency response of run %d is not followed", self._run_id)
                self._run = None

    def look(self) -> None:
        """Take what the loop has published since the last look, and skip what is not needed."""
        life = self._loop.life
        if life is None:
            return
        if life is not self._life:
            self._life, self._reader = life, life.telemetry()
            self._reader.position = self._reader.published
            self._run_id, self._run = 0, None
        assert self._reader is not None
        while len(records := self._reader.read(MOST_TICKS).records):
            for of_run in _by_run(records):
                self._take(life, of_run)

    def tell(self) -> None:
        """Tell of each point that is new or has changed since it was told of."""
        run = self._run
        if run is None:
            return
        with self._lock:
            points = run.conducting.responding.points()
        for found in points:
            point = found.point
            key = (found.method, point.transfer, *point[1:5])
            state = point.cycles, point.settled
            if run.told.get(key) != state:
                run.told[key] = state
                self._tell(run.id, found)

    def _take(self, life: Life, records: Records) -> None:
        """Ticks of one run, or of none."""
        run_id = int(records["run"][0])
        if run_id != self._run_id:
            self.tell()  # what the end of the run before has made
            self._run_id = run_id
            if run_id:
                self._run = self._begun(life, run_id, records)
        run = self._run
        if run is None or run.id != run_id:
            return
        with self._lock:
            segment = run.conducting.take(records)
        if segment is not None and run.conducts and int(records["tick"][-1]) > run.quiet_until:
            self._skip(run, segment)

    def _begun(self, life: Life, run_id: int, records: Records) -> _Run | None:
        known = self._known(run_id)
        if known is None:
            return None
        first = int(records["tick"][0])
        from_its_beginning = int(records["program_tick"][0]) == 0
        recorded = iter(()) if from_its_beginning else known.recorded(first)
        before = next(recorded, None)
        began_at = first if before is None else int(before["tick"][0])
        conducting = Conducting(known.definition, self._period_s, began_at, known.rig)
        while before is not None:
            conducting.take(before)
            before = next(recorded, None)
        return _Run(run_id, conducting, life.lease, conducts=conducting.adapts)

    def _skip(self, run: _Run, segment: int) -> None:
        answer = self._loop.ask(Opcode.SKIP, segment, lease=run.epoch)
        if isinstance(answer, Answer):
            run.quiet_until = answer.tick
        elif answer.code is Code.STALE_LEASE:
            run.conducts = False
            _log.info("run %d plays its full length: command has passed on", run.id)


def _by_run(records: Records) -> list[Records]:
    """Split where another run begins, or none goes on."""
    edges = np.flatnonzero(np.diff(records["run"])) + 1
    return np.split(records, edges)
