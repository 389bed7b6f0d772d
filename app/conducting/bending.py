"""Where a frequency response bends: how far it is, at a frequency, from the line between its neighbours."""

import math
from collections.abc import Mapping
from typing import NamedTuple

from app.definitions.adaptive import AutoResolution


class Answer(NamedTuple):
    """What was measured at a frequency."""

    frequency_hz: float
    gain: float
    phase_deg: float


def bends_between(answers: Mapping[int, Answer], place: int, asked: AutoResolution) -> bool:
    """Whether the response bends at one of the two frequencies `place` and `place + 1`.

    A frequency that has no neighbours on both sides, or was not measured, does not count.
    """
    return any(_bends_at(answers, at, asked) for at in (place, place + 1))


def _bends_at(answers: Mapping[int, Answer], place: int, asked: AutoResolution) -> bool:
    low, middle, high = (answers.get(place + i) for i in (-1, 0, 1))
    if low is None or middle is None or high is None or 0.0 in (low.gain, middle.gain, high.gain):
        return False
    share = _octaves(low, middle) / _octaves(low, high)
    gain_db = _apart_db(low, middle) - share * _apart_db(low, high)
    phase_deg = _apart_deg(low, middle) - share * _apart_deg(low, high)
    return abs(gain_db) > asked.bend_db or abs(phase_deg) > asked.bend_deg


def _octaves(a: Answer, b: Answer) -> float:
    return math.log2(b.frequency_hz / a.frequency_hz)


def _apart_db(a: Answer, b: Answer) -> float:
    return 20 * math.log10(b.gain / a.gain)


def _apart_deg(a: Answer, b: Answer) -> float:
    """The shorter way round."""
    return (b.phase_deg - a.phase_deg + 180.0) % 360.0 - 180.0
