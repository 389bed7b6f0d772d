"""Dead time, rise, overshoot, settling and steady error of a step response."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from rtcore.compiled import entry, inlined

RISE_FROM, RISE_TO = 0.1, 0.9
DEAD_BELOW = 0.05  # of the step: less than that may be noise
SETTLED_WITHIN = 0.02

OUTSIDE = -1
UNSEEN = math.inf  # reached while nobody looked, nobody knows when

_SEEN = np.dtype(
    [
        ("count", "i8"),
        ("last", "i8"),  # sample that was followed last
        (
            "inside",
            "i8",
        ),  # first sample seen in the band since the last outside, OUTSIDE where that was the last
        ("share", "f8"),  # of the step, at the last sample
        ("highest", "f8"),
        (
            "from_at",
            "f8",
        ),  # sample at which RISE_FROM and RISE_TO were first reached; NaN: not yet, UNSEEN
        ("to_at", "f8"),
        ("moves_at", "f8"),  # and DEAD_BELOW
        ("steady_sum", "f8"),  # of the shares from `steady_from` on
        ("steady_count", "i8"),
    ]
)


class StepResponse(NamedTuple):
    """Overshoot in % of the step, rise from 10 to 90 %, time to stay within 2 %, and time to the first 5 %.

    `steady_error` is by how much the mean over the second half of the hold is beside what was commanded,
    in the unit of the step, positive where too little came. NaN where the response did not get that far, or
    got there while ticks were missed or were no numbers. It settles at the first sample seen within 2 %.
    """

    overshoot_percent: float
    rise_s: float
    settling_s: float
    dead_time_s: float = math.nan
    steady_error: float = math.nan


class StepFollower:
    """Reads off the response to a step from `begin` to `end`, piece after piece.

    All is taken against what was commanded, not against where the response ends. Raises ValueError
    where the step has no height.
    """

    def __init__(
        self, begin: float, end: float, period_s: float, steady_from: int | None = None
    ) -> None:
        """`steady_from` is the sample from which the response is held to be steady, None for never."""
        if begin == end:
            raise ValueError("a step needs a height and a response")
        self._steady_from = -1 if steady_from is None else steady_from
        self._begin, self._end, self._period_s = begin, end, period_s
        self._seen = np.zeros(1, _SEEN)
        for name in ("from_at", "to_at", "moves_at"):
            self._seen[name] = math.nan
        self._seen["highest"], self._seen["inside"] = -math.inf, OUTSIDE

    def take(self, samples: npt.NDArray[np.int64], response: npt.NDArray[np.floating]) -> None:
        """The next samples (n,), numbered from the step, and the response (n,) at them."""
        values = np.asarray(response, np.float64)
        numbers = np.ascontiguousarray(samples)
        _follow(self._seen, numbers, values, self._begin, self._end, self._steady_from)

    def read(self) -> StepResponse:
        """What the response amounts to as far as it goes. Raises ValueError before its first sample."""
        seen = self._seen[0]
        if seen["count"] == 0:
            raise ValueError("a step needs a height and a response")
        settling = math.nan if seen["inside"] == OUTSIDE else float(seen["inside"])
        overshoot = float(100 * np.maximum(0.0, seen["highest"] - 1))
        return StepResponse(
            overshoot,
            (self._when("to_at") - self._when("from_at")) * self._period_s,
            settling * self._period_s,
            self._when("moves_at") * self._period_s,
            self._steady_error(),
        )

    def _when(self, level: str) -> float:
        at = float(self._seen[0][level])
        return math.nan if at == UNSEEN else at

    def _steady_error(self) -> float:
        seen = self._seen[0]
        if seen["steady_count"] == 0:
            return math.nan
        share = float(seen["steady_sum"] / seen["steady_count"])
        return (1 - share) * (self._end - self._begin)


def step_response(
    response: npt.NDArray[np.floating], begin: float, end: float, period_s: float
) -> StepResponse:
    """Read off a whole response (n_samples,) to a step at sample 0; see `StepFollower`."""
    follower = StepFollower(begin, end, period_s, len(response) // 2)
    follower.take(np.arange(len(response)), response)
    return follower.read()


@inlined
def _reached(at: float, level: float, sample: int, share: float, before: float) -> float:
    """The place at which a level was first reached, between a sample and that before it."""
    if not math.isnan(at) or not share >= level:
        return at
    if not before < level:
        return UNSEEN
    return sample - (share - level) / (share - before)


@entry
def _follow(
    state: npt.NDArray[np.void],
    samples: npt.NDArray[np.int64],
    response: npt.NDArray[np.float64],
    begin: float,
    end: float,
    steady_from: int,
) -> None:
    seen = state[0]
    for i in range(len(samples)):
        share = (response[i] - begin) / (end - begin)
        before = math.nan  # what the share was a sample ago
        if seen.count == 0 and samples[i] == 0:
            before = -math.inf
        elif seen.count > 0 and samples[i] - seen.last <= 1:
            before = seen.share
        seen.moves_at = _reached(seen.moves_at, DEAD_BELOW, samples[i], share, before)
        seen.from_at = _reached(seen.from_at, RISE_FROM, samples[i], share, before)
        seen.to_at = _reached(seen.to_at, RISE_TO, samples[i], share, before)
        if not (share <= seen.highest) and not np.isnan(seen.highest):
            seen.highest = share
        if not abs(share - 1.0) <= SETTLED_WITHIN:
            seen.inside = OUTSIDE
        elif seen.inside == OUTSIDE:
            seen.inside = samples[i]
        if 0 <= steady_from <= samples[i]:
            seen.steady_sum += share
            seen.steady_count += 1
        seen.share = share
        seen.last = samples[i]
        seen.count += 1
