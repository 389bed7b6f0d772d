"""A hundred thousand ticks of a run allocate nothing and compile nothing, nor does the shell."""

import rtcore  # before Numba, which looks but once for where its cache is

# isort: split
import gc
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numba import njit
from numba.core.dispatcher import Dispatcher
from numba.core.runtime import _nrt_python, rtsys

from rtcore.clock import wait_until
from rtcore.codes import Opcode, Reply
from rtcore.io.simulated import cycle
from rtcore.loop import account, keep_time, warm_up
from rtcore.memory.commands import acknowledgement, post
from rtcore.modes import Mode
from rtcore.rig.faults import FAULTS, Fault
from rtcore.rig.model import make_model
from rtcore.rig.parameters import load_rig
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import gains, harmonic, interlocks, program

pytestmark = pytest.mark.slow

TICKS = 100_000


@pytest.fixture(autouse=True)
def _counting() -> Iterator[None]:
    _nrt_python.memsys_enable_stats()
    yield
    _nrt_python.memsys_disable_stats()


@pytest.fixture
def rig() -> Virtual:
    """Ready, with forty seconds of load on a moving unit under test, its kernels frozen."""
    rig = Virtual(gains(), interlocks())
    rig.io.warm_up()
    warm_up()
    rig.bring_to_ready()
    loaded = program(harmonic(2000.0, 50.0, 2000), harmonic(0.002, 4.0, 160))
    assert rig.load_program(loaded) == Reply.ACCEPTED
    return rig


def allocations() -> int:
    """How often compiled code has asked for memory."""
    stats = rtsys.get_allocation_stats()
    return int(stats.alloc + stats.mi_alloc)


def compilations() -> dict[Any, int]:
    """How many signatures each kernel of the project is compiled for."""
    kernels: list[Any] = [o for o in gc.get_objects() if issubclass(type(o), Dispatcher)]
    return {k: len(k.signatures) for k in kernels if k.__module__.startswith(rtcore.__name__)}


class Run:
    """Ticks of a run, each a call from Python as in the loop, with what an operator does meanwhile."""

    def __init__(self, rig: Virtual, ticks: int, orders: dict[int, Opcode]) -> None:
        self.rig = rig
        self.left = ticks
        self.orders = orders
        self.posted: list[int] = []
        self.modes: set[int] = set()

    def __len__(self) -> int:
        return self.left

    def __call__(self, now_ns: int, latency_ns: int, tick_time_ns: int, missed: int) -> None:
        self.left -= 1
        order = self.orders.get(self.left)
        if order is not None:
            self.posted.append(post(self.rig.block, order, 2, time_to_live_s=1e6))
        self.rig.block.fields["app_heartbeat_ns"] = now_ns
        self.rig.io.cycle(now_ns, latency_ns, tick_time_ns, missed)
        self.modes.add(int(self.rig.mode))


def growth(run: Callable[[], None]) -> tuple[int, list[str]]:
    """What a run has allocated, and which kernels it has compiled anew."""
    compiled = compilations()
    assert cycle in compiled
    allocated = allocations()
    run()
    new = [str(kernel) for kernel, n in compilations().items() if n != compiled.get(kernel)]
    return allocations() - allocated, new


def keep_fake_time(run: Run) -> None:
    """The loop's own shell with a wait that ends at once; every so often it is late by periods."""

    def wait(deadline_ns: int, margin_ns: int) -> int:
        wait_until(0, margin_ns)
        return deadline_ns + (700_000 if run.left % 9973 == 0 else 400)

    keep_time(
        run,
        wait,
        run,
        account,
        block_address=run.rig.block.address,
        start_ns=10**12,
        period_ns=250_000,
        margin_ns=60_000,
    )


def test_a_run_with_all_that_may_happen_in_it_allocates_and_compiles_nothing(rig: Virtual) -> None:
    orders = {
        TICKS - 10: Opcode.START,
        60_000: Opcode.HOLD,
        50_000: Opcode.RESUME,
        40_050: Opcode.SKIP,  # to the sine that tapers out
        40_000: Opcode.STOP,
        15_000: Opcode.START,
        5_000: Opcode.SHUTDOWN,
        4_000: Opcode.RESET,
        3_000: Opcode.TARE,
    }
    run = Run(rig, TICKS, orders)
    assert growth(lambda: keep_fake_time(run)) == (0, [])
    # It was no idle run: it went through these modes, and every order but a hasty tare was taken.
    assert run.modes >= {Mode.READY, Mode.RUNNING, Mode.HOLDING, Mode.STOPPING, Mode.TRIPPED}
    replies = [acknowledgement(rig.block, sequence) for sequence in run.posted]
    answers = [reply and reply[0] for reply in replies]
    assert answers == [Reply.ACCEPTED] * (len(orders) - 1) + [Reply.CAUSE_PRESENT]
    assert rig.block.fields["snapshot"]["deadlines_missed"] > 0


def test_the_adoption_of_a_model_allocates_and_compiles_nothing() -> None:
    rig = Virtual(gains(), interlocks(), twin=True)
    rig.io.warm_up()
    rig.block.fields["models"][1] = make_model(load_rig())
    answers = []

    def adopt_again_and_again() -> None:
        for _ in range(20):
            sequence = post(rig.block, Opcode.ADOPT_MODEL, 1, time_to_live_s=1e6)
            for _ in range(3):
                rig.io.cycle(0, 400, 400, 0)
            answers.append(acknowledgement(rig.block, sequence))

    assert growth(adopt_again_and_again) == (0, [])
    assert [answer and answer[0] for answer in answers] == [Reply.ACCEPTED] * 20


def test_a_rig_with_every_fault_in_turn_allocates_and_compiles_nothing(rig: Virtual) -> None:
    io, amounts = rig.io, rig.io.core["injected"]
    late = {Fault.LATE_TICKS}  # which would take its time

    def break_and_mend() -> None:
        for fault in set(Fault) - late:
            for amount in (FAULTS[fault].default, 0.0):
                amounts[fault] = amount
                for k in range(100):
                    io.cycle(k, 0, 0, 0)

    io.cycle(0, 0, 0, 0)
    assert growth(break_and_mend) == (0, [])


def test_the_count_would_see_an_allocation() -> None:
    allocate = njit(lambda n: np.zeros(n).sum())
    allocate(3)
    before = allocations()
    allocate(3)
    assert allocations() > before


def test_what_is_frozen_refuses_what_it_would_have_to_compile(rig: Virtual) -> None:
    calls: list[tuple[Callable[..., object], int]] = [
        (rig.io.cycle, 3),
        (wait_until, 1),
        (account, 3),
    ]
    for call, others in calls:
        with pytest.raises(TypeError, match="No matching definition"):
            call("now", *[0] * others)
    assert growth(lambda: rig.io.cycle(1.5, 0, 0, 0)) == (0, [])  # type: ignore[arg-type]
