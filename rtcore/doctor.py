"""Is this machine fit for real time? What it says of itself, and what its wake-ups measure."""

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from rtcore.latency import RANGE_US, Counts, Idle, LoopFigures, LoopProbe, longest_s, quantile_s
from rtcore.machine import Finding, Grade, findings, processor_line, stolen_share
from rtcore.realtime import Condition, allowed_cpus

SLICES = 5
SLICE_S = 1.0
PERIOD_NS = 250_000
MARGIN_NS = 60_000
VERY_GOOD_S, POOR_S = 20e-6, 100e-6  # LinuxCNC's guide to jitter
MISSED_UNFIT = 0.01  # share of deadlines
STOLEN_LIMITED = 0.001
EDGES_US = (0, 1, 2, 5, 10, 20, 50, 100, 200, 500, RANGE_US)

ADVICE = {
    "affinity": "let this process use more than one processor (taskset, cpuset)",
    "timer_slack": "allow prctl in this container",
    "cpu_dma_latency": "allow writing to /dev/cpu_dma_latency, or the processor falls asleep",
    "garbage_collector_off": "",
    "mlockall": "add 'memlock unlimited' for this user to /etc/security/limits.conf",
    "sched_fifo": "add 'rtprio 90' for this user to /etc/security/limits.conf",
}


class Verdict(StrEnum):
    """What the machine may be used for."""

    FIT = "fit"
    LIMITED = "usable with limits"
    UNFIT = "not fit"


@dataclass(frozen=True)
class Measured:
    """Wake-ups with the margin and without, and the share of time that the host took meanwhile."""

    with_margin: LoopFigures
    without_margin: LoopFigures
    stolen: float | None


def measure() -> Measured:
    """Slices with the margin and without in turn, so that a disturbance hits both."""
    cpu = allowed_cpus()[-1]
    before = processor_line(cpu)
    found: dict[int, LoopFigures] = {}
    with LoopProbe(Idle, PERIOD_NS, cpu) as probe:
        margins = [MARGIN_NS, 0] * SLICES
        console = Console(stderr=True)
        for margin_ns in track(margins, "measuring wake-ups", console=console, transient=True):
            figures = probe.measure(SLICE_S, margin_ns)
            found[margin_ns] = found[margin_ns] + figures if margin_ns in found else figures
    return Measured(found[MARGIN_NS], found[0], stolen_share(before, processor_line(cpu)))


def of_conditions(conditions: tuple[Condition, ...]) -> Iterator[Finding]:
    """What was had when it was asked for, as the loop asks for it."""
    for name, had, reason in conditions:
        if name in ADVICE:
            grade = Grade.GOOD if had else Grade.LIMITED
            yield Finding(name, reason, grade, "" if had else ADVICE[name])


def of_wakeups(name: str, figures: LoopFigures) -> Finding:
    """How late the wake-ups were, and how many deadlines went by unserved."""
    longest = longest_s(figures.wakeup)
    share = figures.deadlines_missed / (figures.ticks + figures.deadlines_missed)
    seen = (
        f"median {in_us(quantile_s(figures.wakeup, 0.5))}, "
        f"99 % within {in_us(quantile_s(figures.wakeup, 0.99))}, longest {in_us(longest)}; "
        f"{figures.deadlines_missed} deadlines missed of {figures.ticks + figures.deadlines_missed}"
    )
    if share > MISSED_UNFIT:
        return Finding(name, seen, Grade.UNFIT, "stop what else runs here, or take another machine")
    if longest is not None and longest <= POOR_S:
        grade = "very good" if longest <= VERY_GOOD_S else "good"
        return Finding(name, f"{seen}; {grade}", Grade.GOOD)
    return Finding(name, seen, Grade.LIMITED, "isolate a processor for the loop")


def of_stolen(share: float | None) -> Finding:
    """Time that a host took from its guest while we measured."""
    if share is None:
        return Finding("stolen_time", "cannot be seen", Grade.UNKNOWN)
    grade = Grade.GOOD if share <= STOLEN_LIMITED else Grade.LIMITED
    advice = "" if grade == Grade.GOOD else "the host is overbooked: give this guest its own cores"
    return Finding("stolen_time", f"{share:.2%} while measuring", grade, advice)


def verdict_of(found: list[Finding]) -> tuple[Verdict, str]:
    """The verdict and a sentence for it: the worst finding decides."""
    worst = max(finding.grade for finding in found)
    names = ", ".join(finding.name for finding in found if finding.grade == worst)
    if worst == Grade.GOOD:
        return Verdict.FIT, "Fit for a rig."
    if worst == Grade.UNFIT:
        return Verdict.UNFIT, f"Not fit, not even for simulation in real time: {names}."
    if worst == Grade.UNKNOWN:
        return Verdict.LIMITED, f"Usable; before a rig is driven, check by hand: {names}."
    return Verdict.LIMITED, f"Usable for simulation, not for a rig: {names}."


def in_us(time_s: float | None) -> str:
    """A time of a histogram in µs; None is what lies beyond its bins."""
    return f"over {RANGE_US} µs" if time_s is None else f"{time_s * 1e6:.1f} µs"


def grouped(counts: Counts) -> list[tuple[str, int]]:
    """A histogram of 1 µs bins in a few that fit a screen: (range, count)."""
    ends = (*EDGES_US[1:], None)
    labels = [f"{a}-{b} µs" if b else f"over {a} µs" for a, b in zip(EDGES_US, ends, strict=True)]
    return list(zip(labels, np.add.reduceat(counts, EDGES_US).tolist(), strict=True))


def as_document(found: list[Finding], measured: Measured) -> dict[str, object]:
    """Everything for programs. A histogram is a list of [bin in µs, count], empty bins left out."""
    verdict, sentence = verdict_of(found)
    histograms = {
        name: [[int(i), int(figures.wakeup[i])] for i in np.flatnonzero(figures.wakeup)]
        for name, figures in (
            ("margin", measured.with_margin),
            ("no_margin", measured.without_margin),
        )
    }
    return {
        "verdict": verdict.value,
        "sentence": sentence,
        "findings": [
            finding._asdict() | {"grade": finding.grade.name.lower()} for finding in found
        ],
        "wakeup_histograms_us": histograms,
    }


def print_tables(found: list[Finding], measured: Measured) -> None:
    """The findings and the two histograms, for people."""
    console = Console(highlight=False)
    colours = {Grade.GOOD: "green", Grade.LIMITED: "yellow", Grade.UNFIT: "red"}
    table = Table("", "seen", "", "advice", title="Is this machine fit for real time?")
    for name, seen, grade, advice in found:
        mark = f"[{colours.get(grade, 'dim')}]{grade.name.lower()}"
        table.add_row(name.replace("_", " "), seen, mark, advice)
    console.print(table)
    wakeups = Table("wake-up after the deadline", "with margin", "without", title="Wake-ups")
    ranges = zip(
        grouped(measured.with_margin.wakeup), grouped(measured.without_margin.wakeup), strict=True
    )
    for (label, with_margin), (_, without) in ranges:
        wakeups.add_row(label, str(with_margin), str(without))
    console.print(wakeups)
    console.print(f"[bold]{verdict_of(found)[1].replace('_', ' ')}")


def main(as_json: bool) -> int:
    """Look, measure for ten seconds, and print. Exit code 0, whatever the verdict."""
    measured = measure()
    found = [
        *findings(),
        *of_conditions(measured.with_margin.conditions),
        of_stolen(measured.stolen),
        of_wakeups("wakeups_with_margin", measured.with_margin),
        of_wakeups("wakeups_without_margin", measured.without_margin),
    ]
    if as_json:
        json.dump(as_document(found, measured), sys.stdout, ensure_ascii=False, indent=2)
        print()
    else:
        print_tables(found, measured)
    return 0
