"""The loop against the clock: wake-ups, tick times and missed deadlines, with cyclictest beside it.

The whole tick runs a test on the simulated rig, with its telemetry, in a process of its own and in
the loop's own shell. Slices of all that is compared take turns, so that a disturbance of the
machine hits each alike. Medians are interpolated within bins of 1 µs, the loop's and cyclictest's.
"""

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field

from bench import cyclictest
from bench.report import Figure, progress, show, tracked
from bench.running_rig import running_rig
from rtcore.latency import RANGE_US, Counts, LoopFigures, LoopProbe, longest_s, quantile_s
from rtcore.machine import realtime_tasks
from rtcore.realtime import allowed_cpus

PERIODS_NS = (250_000, 100_000)
MARGIN_NS = 60_000
SLICES = 14
SLICE_S = 0.5

MEDIAN_AT_MOST_S = 2e-6
RATIO_AT_MOST = 1.15
TICK_AT_MOST_S = 12e-6


@dataclass
class Measured:
    """What was measured at one period; None where nothing was."""

    with_margin: LoopFigures | None = None
    without_margin: LoopFigures | None = None
    cyclictest: Counts | None = None
    problems: set[str] = field(default_factory=set)

    def take_slice(self, probe: LoopProbe, period_ns: int, cpu: int) -> None:
        """A slice of each, one after the other."""
        self.with_margin = joined(self.with_margin, probe.measure(SLICE_S, MARGIN_NS))
        self.without_margin = joined(self.without_margin, probe.measure(SLICE_S, 0))
        if cyclictest.absent() is None:
            counts = cyclictest.measure(SLICE_S, period_ns, cpu)
            if isinstance(counts, str):
                self.problems.add(counts)
            else:
                before = self.cyclictest
                self.cyclictest = counts if before is None else before + counts


def joined(before: LoopFigures | None, more: LoopFigures) -> LoopFigures:
    """All figures of one kind so far."""
    return more if before is None else before + more


def measure(cpu: int) -> dict[int, Measured]:
    """All slices at all periods, about a minute."""
    found = {period_ns: Measured() for period_ns in PERIODS_NS}
    with ExitStack() as stack:
        probes = {
            period_ns: stack.enter_context(LoopProbe(running_rig, period_ns, cpu))
            for period_ns in PERIODS_NS
        }
        progress("bringing the simulated rig to a running test")
        for probe in probes.values():
            probe.measure(0.1, MARGIN_NS)
        for period_ns in tracked(list(PERIODS_NS) * SLICES, "measuring the loop"):
            found[period_ns].take_slice(probes[period_ns], period_ns, cpu)
    return found


def figures_of(period_ns: int, measured: Measured) -> Iterator[Figure]:
    """The figures at one period, with their targets."""
    rate_hz = round(1e9 / period_ns)
    key, at = f"at_{rate_hz}_hz", f"{rate_hz / 1000:g} kHz"
    margin, bare = measured.with_margin, measured.without_margin
    assert margin is not None
    assert bare is not None
    spun = f"{MARGIN_NS / 1000:g} µs margin"

    def time(name: str, what: str, value: float | None, **target: float) -> Figure:
        note = f"over {RANGE_US} µs, where the histogram ends" if value is None else ""
        return Figure(f"{key}_{name}_s", f"{at}: {what}", value, "s", note=note, **target)

    yield time(
        "wakeup_median",
        f"wake-up, {spun}, median",
        quantile_s(margin.wakeup, 0.5),
        at_most=MEDIAN_AT_MOST_S,
    )
    yield time("wakeup_p99", f"wake-up, {spun}, 99 %", quantile_s(margin.wakeup, 0.99))
    yield time("wakeup_longest", f"wake-up, {spun}, longest", longest_s(margin.wakeup))
    bare_s = quantile_s(bare.wakeup, 0.5)
    yield time("sleep_wakeup_median", "wake-up, no margin, median", bare_s)
    yield time("sleep_wakeup_p99", "wake-up, no margin, 99 %", quantile_s(bare.wakeup, 0.99))
    yield time("sleep_wakeup_longest", "wake-up, no margin, longest", longest_s(bare.wakeup))
    yield late_by_a_period(f"{key}_sleep", f"{at}: no margin", bare.wakeup, period_ns)
    counts = measured.cyclictest
    if counts is not None:
        yardstick_s = quantile_s(counts, 0.5)
        ratio = bare_s / yardstick_s if bare_s and yardstick_s else None
        yield time("cyclictest_median", "cyclictest, median", yardstick_s)
        yield time("cyclictest_p99", "cyclictest, 99 %", quantile_s(counts, 0.99))
        yield time("cyclictest_longest", "cyclictest, longest", longest_s(counts))
        yield late_by_a_period(f"{key}_cyclictest", f"{at}: cyclictest", counts, period_ns)
        yield Figure(
            f"{key}_sleep_to_cyclictest_ratio",
            f"{at}: median without margin / cyclictest's",
            ratio,
            "×",
            at_most=RATIO_AT_MOST,
        )
    yield time(
        "tick_time_median",
        "whole tick, median",
        quantile_s(margin.tick_time, 0.5),
        at_most=TICK_AT_MOST_S,
    )
    yield time("tick_time_p99", "whole tick, 99 %", quantile_s(margin.tick_time, 0.99))
    yield from counted(key, at, margin)


def late_by_a_period(key: str, of: str, counts: Counts, period_ns: int) -> Figure:
    """How often a task that only sleeps slept past a whole period: what the machine itself does."""
    late = int(counts[period_ns // 1000 :].sum())
    note = f"of {int(counts.sum())} wake-ups"
    return Figure(f"{key}_late_by_a_period", f"{of}, a period late or more", late, "", note=note)


def counted(key: str, at: str, figures: LoopFigures) -> Iterator[Figure]:
    """Ticks that ended late and deadlines that were missed, with the margin."""
    note = f"of {figures.ticks + figures.deadlines_missed} deadlines"
    for name, value in (
        ("late_ticks", figures.late_ticks),
        ("deadlines_missed", figures.deadlines_missed),
    ):
        yield Figure(f"{key}_{name}", f"{at}: {name.replace('_', ' ')}", value, "", note=note)


def notes_of(cpu: int, found: dict[int, Measured], disturbers: list[str]) -> list[str]:
    """What the reader of the figures has to know."""
    first = found[PERIODS_NS[0]].with_margin
    assert first is not None
    lacking = [f"{c.name} ({c.reason})" for c in first.conditions if not c.had]
    problems = {problem for measured in found.values() for problem in measured.problems}
    absent = cyclictest.absent()
    return [
        *(f"disturbed by another real-time task: {task}" for task in disturbers),
        f"each of the {SLICES * len(PERIODS_NS) * 3} slices lasted {SLICE_S:g} s, on CPU {cpu}",
        "medians are interpolated within bins of 1 µs, the loop's and cyclictest's alike",
        *([f"conditions that were not had: {', '.join(lacking)}"] if lacking else []),
        *([absent] if absent else []),
        *sorted(problems),
    ]


def main(as_json: bool) -> int:
    """Measure for a minute and print. Exit code 0 when measured, whether targets were met or not."""
    cpu = allowed_cpus()[-1]
    disturbers = realtime_tasks()
    found = measure(cpu)
    figures = [f for period_ns, measured in found.items() for f in figures_of(period_ns, measured)]
    show("loop", figures, notes_of(cpu, found, disturbers), as_json)
    return 0
