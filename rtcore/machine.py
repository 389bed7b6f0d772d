"""What the machine says of itself, judged for real time. Each finding names its source's value.

`root` stands for the root of the file system, so that tests can put another machine there.
"""

import platform
from collections.abc import Callable, Iterator
from enum import IntEnum
from pathlib import Path
from typing import NamedTuple

from rtcore.realtime import preemption_model, runtime_limit_us

ROOT = Path("/")
_CPUS = "sys/devices/system/cpu"
GOOD_CLOCKS = frozenset({"tsc", "arch_sys_counter"})
ENOUGH_RUNTIME_US = 900_000


class Grade(IntEnum):
    """How a finding bears on the verdict; the worst decides."""

    GOOD = 0
    UNKNOWN = 1  # not visible from here, so nothing is claimed
    LIMITED = 2  # good enough for simulation, not for a rig
    UNFIT = 3


class Finding(NamedTuple):
    """One thing looked at: what was seen, how good it is, and what would make it better."""

    name: str
    seen: str
    grade: Grade
    advice: str = ""


def first_line(path: Path) -> str | None:
    """The first line of a file of the kernel; None where it is absent, unreadable or empty."""
    try:
        return path.read_text().strip().partition("\n")[0] or None
    except OSError:
        return None


def _preemption(root: Path) -> Finding:
    model = preemption_model(root / "sys/kernel/realtime", first_line(root / "proc/version") or "")
    seen = f"{model}, {platform.release()}"
    if model == "PREEMPT_RT":
        return Finding("preemption", seen, Grade.GOOD)
    advice = "install a kernel with PREEMPT_RT (Debian: linux-image-rt-amd64)"
    return Finding("preemption", seen, Grade.LIMITED, advice)


def _virtual_machine(root: Path) -> Finding:
    name = "virtual_machine"
    maker = first_line(root / "sys/class/dmi/id/sys_vendor")
    flags = (root / "proc/cpuinfo").read_text() if (root / "proc/cpuinfo").exists() else ""
    if "hypervisor" in flags or (root / "proc/device-tree/hypervisor").exists():
        advice = "run a rig on a machine of its own: a host may stop its guests at any time"
        return Finding(name, f"yes ({maker or 'hypervisor'})", Grade.LIMITED, advice)
    if "flags" in flags:  # only x86 tells by the absence of the flag
        return Finding(name, f"no ({maker or 'maker unknown'})", Grade.GOOD)
    return Finding(name, "cannot be seen", Grade.UNKNOWN, "make sure that this is no guest")


def _processors(root: Path) -> Finding:
    online = first_line(root / _CPUS / "online")
    if online is None:
        return Finding("processors", "cannot be seen", Grade.UNKNOWN)
    if online == "0":
        advice = "give the machine a second processor: the loop needs one for itself"
        return Finding("processors", "1", Grade.LIMITED, advice)
    return Finding("processors", f"{online} online", Grade.GOOD)


def _isolation(root: Path) -> Finding:
    isolated = first_line(root / _CPUS / "isolated")
    tickless = first_line(root / _CPUS / "nohz_full")
    seen = f"isolated: {isolated or 'none'}, without timer tick: {tickless or 'none'}"
    if isolated:
        return Finding("isolation", seen, Grade.GOOD)
    advice = "boot with isolcpus=N nohz_full=N rcu_nocbs=N and give the loop --cpu N"
    return Finding("isolation", seen, Grade.LIMITED, advice)


def _sibling_threads(root: Path) -> Finding:
    active = first_line(root / _CPUS / "smt/active")
    if active is None:
        return Finding("sibling_threads", "cannot be seen", Grade.UNKNOWN)
    if active == "0":
        return Finding("sibling_threads", "off", Grade.GOOD)
    advice = "switch SMT off, or keep the sibling of the loop's processor idle"
    return Finding("sibling_threads", "on", Grade.LIMITED, advice)


def _fifo_runtime(root: Path) -> Finding:
    limit_us = runtime_limit_us(root / "proc/sys/kernel/sched_rt_runtime_us")
    if limit_us is None:
        return Finding("fifo_runtime", "no limit", Grade.GOOD)
    seen = f"{limit_us} µs of each second"
    if limit_us >= ENOUGH_RUNTIME_US:  # the loop sleeps for most of each period
        return Finding("fifo_runtime", seen, Grade.GOOD)
    return Finding("fifo_runtime", seen, Grade.LIMITED, "sysctl kernel.sched_rt_runtime_us=950000")


def _clock_source(root: Path) -> Finding:
    base = root / "sys/devices/system/clocksource/clocksource0"
    seen = first_line(base / "current_clocksource")
    if seen is None:
        return Finding("clock_source", "cannot be seen", Grade.UNKNOWN)
    if seen in GOOD_CLOCKS:
        return Finding("clock_source", seen, Grade.GOOD)
    offered = first_line(base / "available_clocksource") or "none"
    advice = f"boot with clocksource=tsc tsc=reliable (offered here: {offered})"
    return Finding("clock_source", seen, Grade.LIMITED, advice)


def _frequency_governor(root: Path) -> Finding:
    files = sorted((root / _CPUS).glob("cpu[0-9]*/cpufreq/scaling_governor"))
    seen = sorted({first_line(file) or "unreadable" for file in files})
    if not seen:
        advice = "make sure in the firmware that the processor's frequency is fixed"
        return Finding("frequency_governor", "cannot be seen", Grade.UNKNOWN, advice)
    grade = Grade.GOOD if seen == ["performance"] else Grade.LIMITED
    advice = "" if grade == Grade.GOOD else "cpupower frequency-set --governor performance"
    return Finding("frequency_governor", ", ".join(seen), grade, advice)


def _throttling(root: Path) -> Finding:
    files = (root / _CPUS).glob("cpu[0-9]*/thermal_throttle/core_throttle_count")
    counts = [int(line) for file in files if (line := first_line(file)) is not None]
    if not counts:
        return Finding("throttling", "cannot be seen", Grade.UNKNOWN, "watch the temperature")
    if sum(counts) == 0:
        return Finding("throttling", "never since the start", Grade.GOOD)
    advice = "cool the processor better: it slows down when hot"
    return Finding("throttling", f"{sum(counts)} times since the start", Grade.LIMITED, advice)


def _processor_quota(root: Path) -> Finding:
    groups = root / "sys/fs/cgroup"
    members = (root / "proc/self/cgroup").read_text().splitlines()
    own = next((line.removeprefix("0::/") for line in members if line.startswith("0::")), "")
    files = [groups / "cpu/cpu.cfs_quota_us"]  # cgroups of version 1; then ours and those above
    files += [folder / "cpu.max" for folder in (groups / own, *(groups / own).parents)]
    quotas = [line for file in files if (line := first_line(file)) is not None]
    limits = [quota for quota in quotas if quota.split()[0] not in ("max", "-1")]
    if not limits:
        return Finding("processor_quota", "none seen", Grade.GOOD)
    advice = "lift the quota of this container or slice: it stops the loop when used up"
    return Finding("processor_quota", limits[0], Grade.LIMITED, advice)


def realtime_tasks(root: Path = ROOT) -> list[str]:
    """Programs that are scheduled before all ordinary ones, in words; the kernel's own left out."""
    found = []
    for file in sorted((root / "proc").glob("[0-9]*/stat")):
        name, _, rest = (first_line(file) or "").partition("(")[2].rpartition(")")
        values = rest.split()  # from field 3 of proc(5) on
        if len(values) > 38 and int(values[37]) > 0 and int(values[20]) > 0:
            found.append(f"{name} ({file.parent.name}) on CPU {values[36]}")
    return found


def _other_realtime_tasks(root: Path) -> Finding:
    found = realtime_tasks(root)
    if not found:
        return Finding("other_realtime_tasks", "none", Grade.GOOD)
    advice = "end them, or keep them off the loop's processor: they go before it or beside it"
    return Finding("other_realtime_tasks", ", ".join(found), Grade.LIMITED, advice)


CHECKS: tuple[Callable[[Path], Finding], ...] = (
    _preemption,
    _virtual_machine,
    _processors,
    _isolation,
    _sibling_threads,
    _fifo_runtime,
    _clock_source,
    _frequency_governor,
    _throttling,
    _processor_quota,
    _other_realtime_tasks,
)


def findings(root: Path = ROOT) -> Iterator[Finding]:
    """All that can be seen without measuring, in the order of `CHECKS`."""
    return (check(root) for check in CHECKS)


def stolen_share(before: str, after: str) -> float | None:
    """Share of a processor's time that its host gave to others, from two `processor_line`s.

    None where no time went by.
    """
    spent = [int(b) - int(a) for a, b in zip(before.split()[1:9], after.split()[1:9], strict=True)]
    return spent[7] / sum(spent) if sum(spent) > 0 else None


def processor_line(cpu: int, root: Path = ROOT) -> str:
    """The line of one processor in /proc/stat."""
    lines = (root / "proc/stat").read_text().splitlines()
    return next(line for line in lines if line.startswith(f"cpu{cpu} "))
