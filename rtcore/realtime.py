"""The real-time conditions of a process: each asked for, none fatal, each with its reason.

They outlive the calls: what was had is held until the process ends.
"""

import ctypes
import errno
import gc
import json
import os
import platform
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

PRIORITY = 80
MEMORY_LOCK_CURRENT_AND_FUTURE = 1 | 2  # MCL_CURRENT | MCL_FUTURE
PR_SET_TIMERSLACK = 29
LATENCY_DEVICE = Path("/dev/cpu_dma_latency")
REALTIME_FLAG = Path("/sys/kernel/realtime")
RUNTIME_LIMIT = Path("/proc/sys/kernel/sched_rt_runtime_us")


class Condition(NamedTuple):
    """One condition: whether it was had, and what was got or why not, for the operator to read."""

    name: str
    had: bool
    reason: str


def why_refused(error: OSError, needs: str) -> str:
    """A refusal by the system in words; `needs` is what would have permitted it."""
    if error.errno in (errno.EPERM, errno.EACCES):
        return f"no permission: needs {needs}"
    if error.errno == errno.ENOENT:
        return f"this system has no {error.filename}" if error.filename else "not on this system"
    if error.errno == errno.ENOMEM:
        return f"the limit on locked memory is too low: needs {needs}"
    return os.strerror(error.errno) if error.errno else str(error)


def _libc_call(name: str, *arguments: int) -> None:
    """Call a function of the C library that sets errno. Raises `OSError`."""
    function = getattr(ctypes.CDLL(None, use_errno=True), name)
    if function(*arguments) != 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))


def take_fifo(priority: int = PRIORITY) -> Condition:
    """Scheduling before all ordinary processes."""
    name = "sched_fifo"
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except OSError as error:
        needs = "CAP_SYS_NICE or an rtprio limit (ulimit -r)"
        return Condition(name, False, why_refused(error, needs))
    return Condition(name, True, f"priority {priority}")


def lock_memory() -> Condition:
    """No page of the process, now or later, is ever taken from memory."""
    name = "mlockall"
    try:
        _libc_call("mlockall", MEMORY_LOCK_CURRENT_AND_FUTURE)
    except OSError as error:
        needs = "CAP_IPC_LOCK or a memlock limit (ulimit -l)"
        return Condition(name, False, why_refused(error, needs))
    return Condition(name, True, "all pages, present and future")


def allowed_cpus() -> list[int]:
    """The processors that this process may use."""
    return sorted(os.sched_getaffinity(0))


def pin_to_cpu(cpu: int | None = None) -> Condition:
    """One processor only: `cpu`, or the last of those that this process may use."""
    name = "affinity"
    allowed = allowed_cpus()
    chosen = allowed[-1] if cpu is None else cpu
    try:
        os.sched_setaffinity(0, {chosen})
    except OSError as error:
        if error.errno == errno.EINVAL:  # absent, offline, or outside the cpuset
            return Condition(name, False, f"CPU {chosen} is not among those allowed: {allowed}")
        return Condition(name, False, why_refused(error, "CAP_SYS_NICE"))
    return Condition(name, True, f"CPU {chosen} of {allowed}")


def hold_processor_awake(device: Path = LATENCY_DEVICE) -> Condition:
    """No deep sleep states: the kernel keeps them off while the device is held open at 0."""
    name = "cpu_dma_latency"
    try:
        descriptor = os.open(device, os.O_RDWR | os.O_CLOEXEC)  # never closed: see above
        os.write(descriptor, (0).to_bytes(4, "little"))
    except OSError as error:
        return Condition(name, False, why_refused(error, f"write access to {device}"))
    return Condition(name, True, "held at 0 µs")


def stop_timer_slack() -> Condition:
    """An ordinary process is woken up to 50 µs late, to save power; one with FIFO never is."""
    name = "timer_slack"
    try:
        _libc_call("prctl", PR_SET_TIMERSLACK, 1, 0, 0, 0)
    except OSError as error:
        return Condition(name, False, why_refused(error, "prctl"))
    return Condition(name, True, "1 ns")


def stop_garbage_collector() -> Condition:
    """No pause to look for garbage; what exists now is never looked at again."""
    gc.collect()
    gc.disable()
    gc.freeze()
    return Condition("garbage_collector_off", not gc.isenabled(), f"{gc.get_freeze_count()} frozen")


def preemption_model(flag: Path = REALTIME_FLAG, version: str | None = None) -> str:
    """The kernel's preemption model, as far as it tells: `PREEMPT_RT` is the one for a rig."""
    words = (platform.version() if version is None else version).split()
    if flag.exists() and flag.read_text().strip() == "1":
        return "PREEMPT_RT"
    return next((word for word in words if word.startswith("PREEMPT")), "none stated")


def runtime_limit_us(path: Path = RUNTIME_LIMIT) -> int | None:
    """Share of each second, in µs, that FIFO tasks may take; None where there is no limit."""
    limit_us = int(path.read_text()) if path.exists() else -1
    return limit_us if limit_us >= 0 else None


def kernel_conditions() -> list[Condition]:
    """What the kernel is, beside what it grants."""
    model = preemption_model()
    limit_us = runtime_limit_us()
    cut = "no limit" if limit_us is None else f"{limit_us} µs of each second"
    return [
        Condition("preempt_rt", model == "PREEMPT_RT", f"{model} ({platform.release()})"),
        Condition("fifo_unlimited", limit_us is None, cut),
    ]


def take_all(cpu: int | None = None, priority: int = PRIORITY) -> list[Condition]:
    """Ask for every condition and report each. Call it last before the loop: it freezes memory."""
    return [
        pin_to_cpu(cpu),
        stop_timer_slack(),
        hold_processor_awake(),
        stop_garbage_collector(),
        lock_memory(),
        take_fifo(priority),
        *kernel_conditions(),
    ]


def as_json(conditions: Iterable[Condition]) -> bytes:
    """The conditions as the block keeps them: a JSON list of {name, had, reason}."""
    return json.dumps([c._asdict() for c in conditions], ensure_ascii=False).encode()
