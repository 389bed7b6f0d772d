"""The doctor's verdict: the worst finding decides, and nothing is claimed that was not seen."""

import json

import numpy as np
import pytest

from rtcore import doctor
from rtcore.doctor import Measured, Verdict, grouped, of_conditions, of_stolen, of_wakeups
from rtcore.latency import LoopFigures
from rtcore.machine import Finding, Grade
from rtcore.memory.layout import HISTOGRAM_BINS
from rtcore.realtime import Condition

HAD = Condition("sched_fifo", True, "priority 80")


def figures(bins: dict[int, int], missed: int = 0, *conditions: Condition) -> LoopFigures:
    counts = np.zeros(HISTOGRAM_BINS, np.int64)
    for number, count in bins.items():
        counts[number] = count
    return LoopFigures(counts, counts, 0, missed, conditions)


@pytest.mark.parametrize(
    ("bins", "missed", "grade", "words"),
    [
        ({0: 20_000}, 0, Grade.GOOD, "very good"),
        ({0: 19_999, 60: 1}, 0, Grade.GOOD, "longest 61.0 µs"),
        ({0: 19_999, 101: 1}, 0, Grade.LIMITED, "longest 102.0 µs"),
        (
            {0: 19_990, 999: 10},
            50,
            Grade.LIMITED,
            "longest over 999 µs; 50 deadlines missed of 20050",
        ),
        ({0: 19_000}, 300, Grade.UNFIT, "300 deadlines missed of 19300"),
    ],
)
def test_wake_ups_are_judged_by_the_longest_and_by_what_was_missed(
    bins: dict[int, int], missed: int, grade: Grade, words: str
) -> None:
    finding = of_wakeups("wakeups", figures(bins, missed))
    assert finding.grade == grade
    assert words in finding.seen


def test_a_condition_that_was_not_had_limits_and_comes_with_advice() -> None:
    refused = Condition("sched_fifo", False, "no permission")
    assert next(of_conditions((HAD,))).grade == Grade.GOOD
    finding = next(of_conditions((refused,)))
    assert (finding.seen, finding.grade) == ("no permission", Grade.LIMITED)
    assert "rtprio" in finding.advice


@pytest.mark.parametrize(
    ("share", "grade"), [(None, Grade.UNKNOWN), (0.0, Grade.GOOD), (0.002, Grade.LIMITED)]
)
def test_time_taken_by_a_host(share: float | None, grade: Grade) -> None:
    assert of_stolen(share).grade == grade


@pytest.mark.parametrize(
    ("grades", "verdict", "words"),
    [
        ([Grade.GOOD, Grade.GOOD], Verdict.FIT, "Fit for a rig"),
        ([Grade.GOOD, Grade.UNKNOWN], Verdict.LIMITED, "check by hand: thing_1"),
        ([Grade.LIMITED, Grade.UNKNOWN], Verdict.LIMITED, "not for a rig: thing_0"),
        ([Grade.LIMITED, Grade.UNFIT], Verdict.UNFIT, "Not fit"),
    ],
)
def test_the_worst_finding_decides(grades: list[Grade], verdict: Verdict, words: str) -> None:
    found = [Finding(f"thing_{i}", "", grade) for i, grade in enumerate(grades)]
    said, sentence = doctor.verdict_of(found)
    assert said == verdict
    assert words in sentence


def test_groups_of_bins_lose_no_count() -> None:
    counts = np.arange(HISTOGRAM_BINS, dtype=np.int64)
    groups = grouped(counts)
    assert sum(count for _, count in groups) == counts.sum()
    assert groups[2] == ("2-5 µs", 2 + 3 + 4)
    assert groups[-1] == ("over 999 µs", 999)


@pytest.mark.parametrize("as_json", [True, False])
def test_it_prints_one_document_or_tables(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], as_json: bool
) -> None:
    measured = Measured(figures({0: 90, 7: 10}, 0, HAD), figures({20: 100}, 0, HAD), 0.0)
    monkeypatch.setattr(doctor, "measure", lambda: measured)
    monkeypatch.setattr(
        doctor, "findings", lambda: [Finding("preemption", "x", Grade.LIMITED, "y")]
    )
    assert doctor.main(as_json) == 0
    printed = capsys.readouterr().out
    if as_json:
        document = json.loads(printed)
        assert document["verdict"] == "usable with limits"
        assert document["wakeup_histograms_us"]["margin"] == [[0, 90], [7, 10]]
        assert document["findings"][0]["grade"] == "limited"
    else:
        assert "Usable for simulation, not for a rig: preemption." in printed
