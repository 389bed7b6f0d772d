"""What a run was like in time: layers with their cycles and harmonics, steps, the unit, likeness, uncertainty.

One pass over its chunks, in memory that grows with the test's layers and steps only, beside at most 10 MB of slow
cycles; layers and steps are told up to a number. Rainflow counting takes passes of its own:
`app.analysis.rainflow_counting`.
"""

import math
from collections.abc import Iterable
from typing import NamedTuple

from app.analysis import dynamics
from app.analysis.cycle_statistics import CyclesByLayer, LayerCycles
from app.analysis.dynamics import DynamicsReader
from app.analysis.evidence import Kind, Sine, Stretch
from app.analysis.predicted import Predicted
from app.analysis.sines import FoundSine, Harmonic, SineFit
from app.analysis.slow_reader import SlowReader, SlowSine
from app.analysis.step_response import StepFollower, StepResponse
from app.analysis.tally import Tally, Tallying
from app.analysis.uncertainty import Controlled, Known, Measured, controlled, measured
from app.analysis.unit_force import Chain
from app.analysis.walk import NEEDED as WALKED
from app.analysis.walk import Columns, Part, Walk
from rtcore.rig.parameters import RigParameters

NEEDED = tuple(dict.fromkeys([*WALKED, *dynamics.NEEDED]))
MOST_LAYERS = 500
MOST_STEPS = 500


class Layer(NamedTuple):
    """One sine of a block, or a sweep: `sine` and `found` are None there, and nothing is fitted."""

    block: int
    sine: Sine | None
    cycles: LayerCycles
    found: FoundSine | None
    harmonics: tuple[Harmonic, ...]

    @property
    def mean_error_n(self) -> float | None:
        """Mean above (+) or below (−) what was asked for."""
        return None if self.found is None else self.found.mean_n - self.found.asked.mean_n


class Step(NamedTuple):
    """A step of the setpoint, at a tick of the program, and the response to it."""

    block: int
    program_tick: int
    begin_n: float
    end_n: float
    response: StepResponse


class Likeness(NamedTuple):
    """G of the paper's eq. (4) against the prediction; `peak_n` normalises it."""

    percent: float
    peak_n: float
    rms_n: float


class TimeDomain(NamedTuple):
    """All of it; `layers_in_all` and `steps_in_all` count those that are not told too."""

    layers: tuple[Layer, ...]
    layers_in_all: int
    steps: tuple[Step, ...]
    steps_in_all: int
    likeness: Likeness | None
    measured: Measured
    controlled: Controlled
    slow: tuple[SlowSine, ...] = ()


class TimeReader:
    """Takes a run chunk by chunk: each with the columns `NEEDED`, in order."""

    def __init__(
        self,
        stretches: Iterable[Stretch],
        period_s: float,
        rig: RigParameters,
        *,
        predicted: Predicted | None = None,
        first_tick: int | None = None,
        known: Known | None = None,
    ) -> None:
        self._walk = Walk(stretches, period_s, first_tick)
        self._period_s, self._rig, self._known = period_s, rig, known
        self._predicted = predicted
        self._tallying = Tallying(1.0)
        self._tally = Tally()
        self._dynamics = DynamicsReader(Chain.of(rig), period_s)
        self._sines = SineFit(period_s)
        self._cycles = CyclesByLayer()
        self._slow = SlowReader(period_s, rig)
        self._steps: list[Step] = []
        self._steps_in_all = 0
        self._step: tuple[Stretch, StepFollower] | None = None

    def take(self, chunk: Columns) -> None:
        """The next ticks of the run."""
        self._dynamics.take(chunk)
        for part in self._walk.take(chunk):
            self._sines.take(part)
            self._cycles.take(part)
            self._slow.take(part)
            self._follow_step(part)
            self._compare(part)

    def result(self) -> TimeDomain:
        """What it all amounts to; nothing can be taken afterwards."""
        self._end_step()
        self._cycles.close()
        layers = self._layers()
        found = self._dynamics.found
        return TimeDomain(
            tuple(layers[:MOST_LAYERS]),
            len(layers),
            tuple(self._steps),
            self._steps_in_all,
            self._likeness(),
            measured(found, self._rig, self._period_s, self._known),
            controlled(found),
            self._slow.result(),
        )

    def _layers(self) -> list[Layer]:
        fitted: dict[tuple[int, Sine | None], tuple[FoundSine, tuple[Harmonic, ...]]] = {}
        for block in dict.fromkeys(block for (block, _), _ in self._cycles):
            both = zip(
                self._sines.of_block(block), self._sines.harmonics_of_block(block), strict=True
            )
            fitted |= {(block, found.asked): (found, harmonics) for found, harmonics in both}
        return [
            Layer(*layer, cycles, *fitted.get(layer, (None, ()))) for layer, cycles in self._cycles
        ]

    def _follow_step(self, part: Part) -> None:
        stretch = part.stretch
        if part.begins:
            self._end_step()
            if stretch.kind is Kind.STEP and stretch.begin_n != stretch.end_n:
                steady_from = (stretch.last - stretch.first) // 2
                ends = stretch.begin_n, stretch.end_n
                self._step = stretch, StepFollower(*ends, self._period_s, steady_from)
        if self._step is not None:
            self._step[1].take(part.positions - stretch.first, part.columns["force_n"])

    def _end_step(self) -> None:
        step, self._step = self._step, None
        if step is None:
            return
        stretch, follower = step
        self._steps_in_all += 1
        if len(self._steps) < MOST_STEPS:
            ends = stretch.begin_n, stretch.end_n
            self._steps.append(Step(stretch.block, stretch.first, *ends, follower.read()))

    def _compare(self, part: Part) -> None:
        if self._predicted is None:
            return
        reference_n = self._predicted.at(part.positions)
        if part.stretch.kind is not Kind.LEAD:
            self._tally.add(self._tallying.of(part, reference_n))

    def _likeness(self) -> Likeness | None:
        percent, peak_n = self._tally.goodness_percent, self._tally.goodness_peak_n
        if percent is None or peak_n is None:
            return None
        return Likeness(percent, peak_n, (1 - percent / 100) * peak_n if peak_n > 0 else math.nan)
