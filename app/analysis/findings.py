"""What was found in a run or one of its blocks; the measurements are read off it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.sine_responses import Required
from app.analysis.sines import FoundSine
from app.analysis.step_response import StepResponse
from app.analysis.tally import Tally


@dataclass
class CycleStatistics:
    """Peaks and valleys of the force over cycles. Those that a hold or a gap cut only count."""

    count: int = 0
    whole: int = 0
    peak_sum_n: float = 0.0
    valley_sum_n: float = 0.0
    highest_n: float = -math.inf
    lowest_n: float = math.inf

    def take(self, rows: npt.NDArray[Any]) -> None:
        """Count (n,) CYCLE."""
        if len(rows) == 0:
            return
        whole = rows[rows["whole"]]
        peaks_n, valleys_n = whole["peak_n"], whole["valley_n"]
        self.count += len(rows)
        self.whole += len(whole)
        self.peak_sum_n += float(np.sum(peaks_n))
        self.valley_sum_n += float(np.sum(valleys_n))
        self.highest_n = float(np.max(peaks_n, initial=self.highest_n))
        self.lowest_n = float(np.min(valleys_n, initial=self.lowest_n))

    def add(self, other: "CycleStatistics") -> None:
        """Count another's cycles too."""
        self.count += other.count
        self.whole += other.whole
        self.peak_sum_n += other.peak_sum_n
        self.valley_sum_n += other.valley_sum_n
        self.highest_n = float(np.maximum(self.highest_n, other.highest_n))
        self.lowest_n = float(np.minimum(self.lowest_n, other.lowest_n))


@dataclass
class StepStatistics:
    """The worst of all steps; NaN where one did not get that far."""

    worst: StepResponse | None = None

    def take(self, step: StepResponse) -> None:
        """Count a step."""
        either_way = step._replace(steady_error=abs(step.steady_error))
        if self.worst is None:
            self.worst = either_way
            return
        self.worst = StepResponse(*(float(x) for x in np.maximum(self.worst, either_way)))


@dataclass
class Findings:
    """What was found: `whole` over all ticks, `data` over those that are data."""

    whole: Tally = field(default_factory=Tally)
    data: Tally = field(default_factory=Tally)
    cycles: CycleStatistics = field(default_factory=CycleStatistics)
    steps: StepStatistics = field(default_factory=StepStatistics)
    sines: Sequence[FoundSine] = ()
    required: Sequence[Required] = ()  # of the responses at the sines
    has_cycles: bool = False  # whether it counts cycles, reached or not
    period_s: float = 0.0

    def of_the_one_sine(self, read: Callable[[FoundSine], float | None]) -> float | None:
        """Of a sine; None where there are several, for theirs cannot be told in one number."""
        return read(self.sines[0]) if len(self.sines) == 1 else None

    def worst_sine(self, read: Callable[[FoundSine], float | None]) -> float | None:
        """The value farthest from zero among all sines; NaN where one has it."""
        values = [value for sine in self.sines if (value := read(sine)) is not None]
        nans = [value for value in values if math.isnan(value)]
        return nans[0] if nans else max(values, key=abs, default=None)
