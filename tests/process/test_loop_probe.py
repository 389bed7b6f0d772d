"""The probe that bench and doctor measure with: the loop's own shell, in a process of its own."""

from time import monotonic_ns

import pytest

from bench.running_rig import running_rig
from rtcore.latency import Idle, LoopProbe
from rtcore.modes import Mode

pytestmark = [pytest.mark.process, pytest.mark.slow]

PERIOD_NS = 1_000_000


def test_each_measurement_starts_anew_and_counts_no_more_than_time_allows() -> None:
    with LoopProbe(Idle, PERIOD_NS) as probe:
        for margin_ns in (0, 60_000):
            begun_ns = monotonic_ns()
            figures = probe.measure(0.2, margin_ns)
            deadlines = (monotonic_ns() - begun_ns) // PERIOD_NS
            assert 0 < figures.ticks == figures.tick_time.sum()
            assert figures.ticks + figures.deadlines_missed <= deadlines


def test_what_the_bench_measures_is_a_running_test() -> None:
    rig = running_rig(250_000)
    for tick in range(2000):
        rig.cycle(monotonic_ns(), 500, 9_000, 50 if tick == 1000 else 0)
    assert rig.core["mode"] == Mode.RUNNING
    assert rig.core["run"] == 1
