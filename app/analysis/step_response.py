"""Overshoot, rise and settling of a step response."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

RISE_FROM, RISE_TO = 0.1, 0.9
SETTLED_WITHIN = 0.02


class StepResponse(NamedTuple):
    """Overshoot in % of the step, rise from 10 to 90 %, and time to stay within 2 %.

    NaN where the response did not get that far.
    """

    overshoot_percent: float
    rise_s: float
    settling_s: float


def step_response(
    response: npt.NDArray[np.floating], begin: float, end: float, period_s: float
) -> StepResponse:
    """Read off a response (n_samples,) to a step at sample 0 from `begin` to `end`.

    All is taken against what was commanded, not against where the response ends. Raises ValueError
    where the step has no height or the response no samples.
    """
    if begin == end or len(response) == 0:
        raise ValueError("a step needs a height and a response")
    share = (np.asarray(response, np.float64) - begin) / (end - begin)
    rise = _first_above(share, RISE_TO) - _first_above(share, RISE_FROM)
    return StepResponse(
        float(100 * max(0.0, np.max(share) - 1)), float(rise * period_s), _settling(share, period_s)
    )


def _first_above(share: npt.NDArray[np.float64], level: float) -> float:
    """The sample, with its fraction, at which the response first reaches a level."""
    above = np.flatnonzero(share >= level)
    if len(above) == 0:
        return float("nan")
    i = int(above[0])
    if i == 0:
        return 0.0
    return i - float((share[i] - level) / (share[i] - share[i - 1]))


def _settling(share: npt.NDArray[np.float64], period_s: float) -> float:
    outside = np.flatnonzero(~(np.abs(share - 1) <= SETTLED_WITHIN))
    if len(outside) == 0:
        return 0.0
    last = int(outside[-1])
    return float("nan") if last == len(share) - 1 else (last + 1) * period_s
