"""Real-time conditions: each is had or refused with a reason, and a refusal is never fatal."""

import ctypes
import errno
import gc
import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from rtcore import realtime
from rtcore.memory.layout import CONDITIONS_BYTES
from rtcore.realtime import Condition


@pytest.fixture(autouse=True)
def _as_before() -> Iterator[None]:
    """Conditions outlive the call, but not the test."""
    cpus = os.sched_getaffinity(0)
    yield
    os.sched_setaffinity(0, cpus)
    gc.enable()
    gc.unfreeze()


def refuse(monkeypatch: pytest.MonkeyPatch, target: str, number: int) -> None:
    def refused(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(target, refused)


def test_fifo_without_permission_says_what_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    refuse(monkeypatch, "os.sched_setscheduler", errno.EPERM)
    reason = "no permission: needs CAP_SYS_NICE or an rtprio limit (ulimit -r)"
    assert realtime.take_fifo(80) == Condition("sched_fifo", False, reason)


def test_fifo_asks_for_the_priority(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[int, int, int]] = []
    monkeypatch.setattr(
        "os.sched_setscheduler",
        lambda pid, policy, p: asked.append((pid, policy, p.sched_priority)),
    )
    assert realtime.take_fifo(73).had
    assert asked == [(0, os.SCHED_FIFO, 73)]


@pytest.mark.parametrize(
    ("number", "words"), [(errno.EPERM, "no permission"), (errno.ENOMEM, "limit on locked memory")]
)
def test_memory_that_may_not_be_locked_says_why(
    monkeypatch: pytest.MonkeyPatch, number: int, words: str
) -> None:
    class Libc:
        def __init__(self, *_: object, **__: object) -> None: ...

        def mlockall(self, flags: int) -> int:
            assert flags == 3, "MCL_CURRENT | MCL_FUTURE"
            ctypes.set_errno(number)
            return -1

    monkeypatch.setattr("ctypes.CDLL", Libc)
    condition = realtime.lock_memory()
    assert not condition.had
    assert words in condition.reason
    assert "CAP_IPC_LOCK" in condition.reason


def test_the_latency_device_is_held_at_zero(tmp_path: Path) -> None:
    device = tmp_path / "cpu_dma_latency"
    device.touch()
    assert realtime.hold_processor_awake(device).had
    assert device.read_bytes() == bytes(4)
    held = [entry.resolve() for entry in Path("/proc/self/fd").iterdir()]
    assert device.resolve() in held, "the kernel forgets the wish when the file is closed"


def test_a_missing_latency_device_is_named(tmp_path: Path) -> None:
    device = tmp_path / "cpu_dma_latency"
    condition = realtime.hold_processor_awake(device)
    assert condition == Condition("cpu_dma_latency", False, f"this system has no {device}")


def test_the_last_processor_is_taken_unless_told() -> None:
    allowed = os.sched_getaffinity(0)
    assert realtime.pin_to_cpu().had
    assert os.sched_getaffinity(0) == {max(allowed)}


def test_the_processor_that_is_told_is_taken() -> None:
    first = min(os.sched_getaffinity(0))
    assert realtime.pin_to_cpu(first).had
    assert os.sched_getaffinity(0) == {first}


def test_a_processor_outside_the_set_is_refused_and_nothing_changes() -> None:
    allowed = os.sched_getaffinity(0)
    condition = realtime.pin_to_cpu(1023)
    assert not condition.had
    assert "CPU 1023 is not among those allowed" in condition.reason
    assert os.sched_getaffinity(0) == allowed


def test_the_garbage_collector_is_off() -> None:
    assert realtime.stop_garbage_collector().had
    assert not gc.isenabled()
    assert gc.get_freeze_count() > 0


@pytest.mark.parametrize(
    ("version", "flag", "model"),
    [
        ("#1 SMP PREEMPT_RT Debian 6.12.9-1", None, "PREEMPT_RT"),
        ("#1 SMP PREEMPT_DYNAMIC @0", None, "PREEMPT_DYNAMIC"),
        ("#1 SMP Debian 6.1.20-1", None, "none stated"),
        ("#1 SMP PREEMPT 4.19", "1\n", "PREEMPT_RT"),
        ("#1 SMP PREEMPT 4.19", "0\n", "PREEMPT"),
    ],
)
def test_the_kernel_says_how_it_preempts(
    tmp_path: Path, version: str, flag: str | None, model: str
) -> None:
    file = tmp_path / "realtime"
    if flag is not None:
        file.write_text(flag)
    assert realtime.preemption_model(file, version) == model


@pytest.mark.parametrize(("text", "limit_us"), [("950000\n", 950_000), ("-1\n", None), ("0", 0)])
def test_the_limit_on_fifo_tasks(tmp_path: Path, text: str, limit_us: int | None) -> None:
    file = tmp_path / "sched_rt_runtime_us"
    file.write_text(text)
    assert realtime.runtime_limit_us(file) == limit_us


def test_conditions_fit_the_block_and_come_back() -> None:
    conditions = [
        Condition("sched_fifo", True, "priority 80"),
        *[Condition("µ", False, "x" * 150)] * 9,
    ]
    stored = realtime.as_json(conditions)
    assert len(stored) <= CONDITIONS_BYTES
    assert [Condition(**found) for found in json.loads(stored)] == conditions
