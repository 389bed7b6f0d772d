"""What a judged run becomes in the tables, and what of a run cut short still passes."""

import math
from typing import Any

import pytest

from app.analysis.acceptance import Verdict
from app.analysis.measurements import nothing
from app.analysis.measuring import Measured
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.prediction.judgement import Judged, judge_measured
from app.runs.verdicts import criterion_rows, measurement_rows

SINE = {"kind": "harmonic", "amplitude_n": 100, "frequency_hz": 10, "cycles": 5}


def _judged(*acceptance: dict[str, Any], completed: bool = True, **values: Any) -> Judged:
    """Of two blocks of which the first was finished, with the same values in both and the whole."""
    data = {"schema": 1, "name": "rows", "blocks": [SINE, SINE, SINE]}
    definition = definition_from(data | {"acceptance": list(acceptance)})
    assert isinstance(definition, Definition), definition.detail
    found = nothing() | values
    measured = Measured(found, {0: found, 1: found}, frozenset({0}), ())
    return judge_measured(definition, measured, completed=completed)


def test_every_value_has_a_row_and_none_that_was_not_measured() -> None:
    rows = measurement_rows(7, _judged(mean_n=3.0, amplitude_n=90.0))
    assert {(row["block"], row["name"], row["value"]) for row in rows} == {
        (block, name, value)
        for block in (-1, 0, 1)
        for name, value in (("mean_n", 3.0), ("amplitude_n", 90.0))
    }
    assert {row["outcome"] for row in rows} == {None}
    assert {row["run_id"] for row in rows} == {7}


def test_of_several_criteria_on_a_value_the_row_has_the_tightest_limits_and_the_worst_outcome() -> (
    None
):
    judged = _judged(
        {"measurement": "mean_n", "at_least": 1, "at_most": 9},
        {"measurement": "mean_n", "at_least": 2, "at_most": 2.5},
        {"measurement": "mean_n", "block": 1, "at_most": 4},
        mean_n=3.0,
    )
    by_block = {row["block"]: row for row in measurement_rows(7, judged)}
    assert (by_block[-1]["at_least"], by_block[-1]["at_most"]) == (2, 2.5)
    assert by_block[-1]["outcome"] == "fail"
    assert (by_block[1]["at_least"], by_block[1]["at_most"]) == (None, 4)
    assert by_block[1]["outcome"] == "pass"
    assert by_block[0]["outcome"] is None
    rows = criterion_rows(7, judged)
    assert [row["position"] for row in rows] == [0, 1, 2]
    assert [row["outcome"] for row in rows] == ["pass", "fail", "pass"]


def test_what_a_criterion_asks_of_a_block_that_was_not_reached_has_a_row_without_a_value() -> None:
    judged = _judged({"measurement": "mean_n", "block": 2, "at_most": 4}, mean_n=3.0)
    [row] = [row for row in measurement_rows(7, judged) if row["block"] == 2]
    assert (row["value"], row["outcome"], row["unit"]) == (None, "unset", "N")
    assert judged.verdict is Verdict.UNSET


def test_what_is_no_number_fails_and_is_kept_as_none() -> None:
    judged = _judged({"measurement": "step_settling_s", "at_most": 1}, step_settling_s=math.nan)
    assert judged.verdict is Verdict.FAIL
    assert [row["value"] for row in criterion_rows(7, judged)] == [None]
    assert {row["value"] for row in measurement_rows(7, judged)} == {None}


@pytest.mark.parametrize(
    ("criterion", "values", "outcome"),
    [
        # a block that was played to its end is judged as ever
        ({"measurement": "mean_n", "block": 0, "at_most": 4}, {"mean_n": 3.0}, "pass"),
        ({"measurement": "mean_n", "block": 0, "at_most": 2}, {"mean_n": 3.0}, "fail"),
        ({"measurement": "cycles", "block": 0, "at_least": 9}, {"cycles": 3.0}, "fail"),
        # what was cut short does not pass
        ({"measurement": "mean_n", "block": 1, "at_most": 4}, {"mean_n": 3.0}, "unset"),
        ({"measurement": "mean_n", "at_most": 4}, {"mean_n": 3.0}, "unset"),
        # what was broken already stays broken
        ({"measurement": "mean_n", "block": 1, "at_most": 2}, {"mean_n": 3.0}, "fail"),
        ({"measurement": "peak_force_n", "at_most": 2}, {"peak_force_n": 3.0}, "fail"),
        # what could still have come is not known
        ({"measurement": "cycles", "at_least": 9}, {"cycles": 3.0}, "unset"),
        ({"measurement": "cycles", "at_least": 1, "at_most": 2}, {"cycles": 3.0}, "fail"),
    ],
)
def test_what_was_cut_short_never_passes(
    criterion: dict[str, Any], values: dict[str, float], outcome: str
) -> None:
    judged = _judged(criterion, completed=False, **values)
    assert [c.outcome.value for c in judged.criteria] == [outcome]
    assert judged.verdict is not Verdict.PASS
