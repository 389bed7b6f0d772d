"""What a machine says of itself, from the files of kernels that differ in one thing each."""

from pathlib import Path
from typing import NamedTuple

import pytest

from rtcore.machine import Grade, findings, realtime_tasks, stolen_share

FIT = {
    "proc/version": "Linux version 6.12.9-rt (x) #1 SMP PREEMPT_RT Debian",
    "proc/cpuinfo": "flags : fpu tsc",
    "proc/self/cgroup": "0::/user.slice/shell.scope",
    "proc/sys/kernel/sched_rt_runtime_us": "950000",
    "sys/devices/system/cpu/online": "0-7",
    "sys/devices/system/cpu/isolated": "7",
    "sys/devices/system/cpu/smt/active": "0",
    "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor": "performance",
    "sys/devices/system/cpu/cpu7/cpufreq/scaling_governor": "performance",
    "sys/devices/system/cpu/cpu0/thermal_throttle/core_throttle_count": "0",
    "sys/devices/system/clocksource/clocksource0/current_clocksource": "tsc",
    "sys/devices/system/clocksource/clocksource0/available_clocksource": "tsc hpet",
    "sys/fs/cgroup/user.slice/shell.scope/cpu.max": "max 100000",
}


def grades(root: Path, files: dict[str, str | None]) -> dict[str, Grade]:
    for name, text in files.items():
        if text is not None:
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + "\n")
    return {finding.name: finding.grade for finding in findings(root)}


def test_a_machine_that_is_fit_has_nothing_against_it(tmp_path: Path) -> None:
    assert set(grades(tmp_path, {**FIT}).values()) == {Grade.GOOD}


class Case(NamedTuple):
    file: str
    text: str | None  # None: the file is absent
    name: str
    grade: Grade


CPU = "sys/devices/system/cpu"
CLOCK = "sys/devices/system/clocksource/clocksource0/current_clocksource"


def task(priority: int, memory_bytes: int = 4096) -> str:
    """A line of /proc/77/stat of a program on processor 1, see proc(5)."""
    values = {3: "S", 23: memory_bytes, 39: 1, 40: priority}
    rest = " ".join(str(values.get(field, 0)) for field in range(3, 53))
    return f"77 (a (b) c) {rest}"


CASES = [
    Case("proc/77/stat", task(priority=80), "other_realtime_tasks", Grade.LIMITED),
    Case("proc/77/stat", task(priority=0), "other_realtime_tasks", Grade.GOOD),
    Case("proc/77/stat", task(priority=99, memory_bytes=0), "other_realtime_tasks", Grade.GOOD),
    Case("proc/version", "Linux #1 SMP PREEMPT_DYNAMIC", "preemption", Grade.LIMITED),
    Case("proc/cpuinfo", "flags : fpu hypervisor", "virtual_machine", Grade.LIMITED),
    Case("proc/cpuinfo", "Features : fp asimd", "virtual_machine", Grade.UNKNOWN),
    Case(f"{CPU}/online", "0", "processors", Grade.LIMITED),
    Case(f"{CPU}/isolated", "", "isolation", Grade.LIMITED),
    Case(f"{CPU}/smt/active", "1", "sibling_threads", Grade.LIMITED),
    Case(f"{CPU}/smt/active", None, "sibling_threads", Grade.UNKNOWN),
    Case("proc/sys/kernel/sched_rt_runtime_us", "500000", "fifo_runtime", Grade.LIMITED),
    Case("proc/sys/kernel/sched_rt_runtime_us", "-1", "fifo_runtime", Grade.GOOD),
    Case(CLOCK, "hpet", "clock_source", Grade.LIMITED),
    Case(CLOCK, None, "clock_source", Grade.UNKNOWN),
    Case(f"{CPU}/cpu7/cpufreq/scaling_governor", "powersave", "frequency_governor", Grade.LIMITED),
    Case(f"{CPU}/cpu0/thermal_throttle/core_throttle_count", "3", "throttling", Grade.LIMITED),
    Case(f"{CPU}/cpu0/thermal_throttle/core_throttle_count", None, "throttling", Grade.UNKNOWN),
    Case("sys/fs/cgroup/user.slice/cpu.max", "50000 100000", "processor_quota", Grade.LIMITED),
    Case("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "50000", "processor_quota", Grade.LIMITED),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.name}: {case.text}")
def test_one_thing_is_found_and_nothing_else(tmp_path: Path, case: Case) -> None:
    found = grades(tmp_path, {**FIT, case.file: case.text})
    assert found.pop(case.name) == case.grade
    assert set(found.values()) == {Grade.GOOD}


def test_a_limit_comes_with_advice(tmp_path: Path) -> None:
    grades(tmp_path, {**FIT})
    for case in CASES:
        (tmp_path / case.file).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / case.file).write_text(case.text or "")
    limited = [finding for finding in findings(tmp_path) if finding.grade == Grade.LIMITED]
    assert limited
    assert all(finding.advice for finding in limited)


def test_a_realtime_task_is_named(tmp_path: Path) -> None:
    grades(tmp_path, {**FIT, "proc/77/stat": task(priority=80)})
    assert realtime_tasks(tmp_path) == ["a (b) c (77) on CPU 1"]


def test_stolen_time_is_a_share_of_all_time_that_went_by() -> None:
    before = "cpu1 100 0 50 800 0 0 0 10 0 0"
    assert stolen_share(before, "cpu1 110 0 55 875 0 0 0 20 0 0") == pytest.approx(0.1)
    assert stolen_share(before, before) is None
