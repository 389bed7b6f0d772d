"""From measurements and limits to a verdict."""

from collections.abc import Iterable
from enum import StrEnum


class Verdict(StrEnum):
    """Of a criterion or a whole run. Unset: nothing was asked, or nothing could be measured."""

    PASS = "pass"
    FAIL = "fail"
    UNSET = "unset"


def judge(value: float | None, at_least: float | None, at_most: float | None) -> Verdict:
    """Whether a value is within its limits. NaN fails; a value that was not measured is unset."""
    if value is None:
        return Verdict.UNSET
    above = at_least is None or value >= at_least
    below = at_most is None or value <= at_most
    # A NaN is neither above nor below anything, but a missing limit would let it through.
    return Verdict.PASS if above and below and value == value else Verdict.FAIL


def overall(verdicts: Iterable[Verdict]) -> Verdict:
    """The verdict of a run: as bad as its worst criterion, unset where it has none."""
    found = set(verdicts)
    for verdict in (Verdict.FAIL, Verdict.UNSET, Verdict.PASS):
        if verdict in found:
            return verdict
    return Verdict.UNSET
