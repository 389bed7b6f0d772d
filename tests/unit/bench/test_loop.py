"""The benchmark of the loop: cyclictest's output read, and figures made of histograms."""

import subprocess

import numpy as np
import pytest

from bench import cyclictest
from bench.loop import Measured, figures_of, joined, notes_of
from rtcore.latency import Counts, LoopFigures
from rtcore.memory.layout import HISTOGRAM_BINS
from rtcore.realtime import Condition

PRINTED = """# /dev/cpu_dma_latency set to 0us
# Histogram
000000 000000
000017 000329
000021 000978
000399 000001
# Total: 000001308
# Min Latencies: 00017
# Avg Latencies: 00023
# Max Latencies: 00503
# Histogram Overflows: 00113
# Histogram Overflow at cycle number:
# Thread 0: 00008 00011 # 00111 others
"""


def test_the_histogram_of_cyclictest_is_read_with_its_overflow() -> None:
    counts = cyclictest.read(PRINTED)
    assert {int(i): int(counts[i]) for i in np.flatnonzero(counts)} == {
        17: 329,
        21: 978,
        399: 1,
        HISTOGRAM_BINS - 1: 113,
    }


def test_a_cyclictest_that_fails_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    def failed(command: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        return subprocess.CompletedProcess(command, 1, "", "warning\nUnable to change policy\n")

    monkeypatch.setattr("subprocess.run", failed)
    assert cyclictest.measure(1.0, 250_000, 0) == "cyclictest failed: Unable to change policy"


def test_cyclictest_is_asked_for_the_same_period_and_time(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def run(command: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        asked.extend(command)
        return subprocess.CompletedProcess(command, 0, PRINTED, "")

    monkeypatch.setattr("subprocess.run", run)
    cyclictest.measure(1.5, 250_000, 3)
    assert {"-i250", "-l6000", "-a3", "-p80", "-m"} <= set(asked)


def counts(bin_us: int, number: int = 1000) -> Counts:
    filled = np.zeros(HISTOGRAM_BINS, np.int64)
    filled[bin_us] = number
    return filled


def loop(wakeup_us: int, tick_us: int, late: int = 0, missed: int = 0) -> LoopFigures:
    held = (Condition("sched_fifo", False, "no permission"),)
    return LoopFigures(counts(wakeup_us), counts(tick_us), late, missed, held)


MEASURED = Measured(loop(1, 8, late=2, missed=5), loop(23, 8), counts(20))


def test_figures_are_medians_and_their_ratio_with_targets() -> None:
    figures = {f.name: f for f in figures_of(250_000, MEASURED)}
    expected = {
        "wakeup_median_s": (1.5e-6, True),
        "sleep_wakeup_median_s": (23.5e-6, None),
        "cyclictest_median_s": (20.5e-6, None),
        "sleep_to_cyclictest_ratio": (23.5 / 20.5, True),
        "tick_time_median_s": (8.5e-6, True),
        "late_ticks": (2, None),
        "deadlines_missed": (5, None),
    }
    for name, (value, met) in expected.items():
        figure = figures[f"at_4000_hz_{name}"]
        assert figure.value == pytest.approx(value)
        assert figure.met is met
    assert figures["at_4000_hz_deadlines_missed"].note == "of 1005 deadlines"


def test_wake_ups_a_period_late_are_counted_beside_those_of_cyclictest() -> None:
    with_late = counts(20) + counts(99, 7) + counts(100, 3) + counts(HISTOGRAM_BINS - 1, 2)
    measured = Measured(loop(1, 8), loop(101, 8), with_late)
    figures = {f.name: f for f in figures_of(100_000, measured)}
    assert figures["at_10000_hz_sleep_late_by_a_period"].value == 1000
    assert figures["at_10000_hz_cyclictest_late_by_a_period"].value == 5


def test_targets_can_be_missed() -> None:
    slow = Measured(loop(2, 12), loop(24, 12), counts(20))
    missed = {f.name for f in figures_of(100_000, slow) if f.met is False}
    assert missed == {
        "at_10000_hz_wakeup_median_s",
        "at_10000_hz_sleep_to_cyclictest_ratio",
        "at_10000_hz_tick_time_median_s",
    }


def test_without_cyclictest_the_rest_is_told_and_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    alone = Measured(MEASURED.with_margin, MEASURED.without_margin)
    names = [f.name for f in figures_of(250_000, alone)]
    assert not any("cyclictest" in name for name in names)
    assert "at_4000_hz_wakeup_median_s" in names
    notes = notes_of(1, {250_000: alone, 100_000: alone}, ["python (7) on CPU 1"])
    assert any("cyclictest is not installed" in note for note in notes)
    assert any("sched_fifo (no permission)" in note for note in notes)
    assert "disturbed by another real-time task: python (7) on CPU 1" in notes


def test_slices_are_added_up() -> None:
    both = joined(joined(None, loop(1, 8, late=2, missed=5)), loop(1, 8, late=1))
    assert (both.ticks, both.late_ticks, both.deadlines_missed) == (2000, 3, 5)
