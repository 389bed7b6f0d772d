"""The thin shell around the tick: wait for the deadline, call the cycle, keep the figures of it."""

from collections.abc import Callable, Sized
from typing import Any

import numpy as np

from rtcore.clock import now_ns, wait_until
from rtcore.compiled import address_of, carray, kernel, offset_of, pointer, store_release
from rtcore.memory.layout import BLOCK, HISTOGRAM_BIN_S, HISTOGRAM_BINS

BIN_NS = round(HISTOGRAM_BIN_S * 1e9)
_HEARTBEAT = offset_of(BLOCK, "loop_heartbeat_ns")

Wait = Callable[[int, int], int]  # deadline_ns, margin_ns → woke_ns
Cycle = Callable[[int, int, int, int], None]  # now_ns, wakeup_latency_ns, tick_time_ns, missed
Account = Callable[[int, int, int, int], int]  # address, deadline_ns, woke_ns, latency_ns


def keep_time(
    running: Sized,
    wait: Wait,
    cycle: Cycle,
    account: Account,
    *,
    block_address: int,
    start_ns: int,
    period_ns: int,
    margin_ns: int,
) -> None:
    """Call `cycle` once a period, from one period after `start_ns`, until `running` is empty.

    A wake-up that is one or more periods late serves the latest deadline that has passed; those
    before it are missed: counted, skipped, never caught up. `cycle` learns how late the wake-up
    was, how long the cycle before took, and how many deadlines were missed since then.
    """
    deadline_ns = start_ns
    tick_time_ns = 0
    while running:
        deadline_ns += period_ns
        woke_ns = wait(deadline_ns, margin_ns)
        latency_ns = woke_ns - deadline_ns
        missed = latency_ns // period_ns
        deadline_ns += missed * period_ns
        cycle(woke_ns, latency_ns, tick_time_ns, missed)
        tick_time_ns = account(block_address, deadline_ns, woke_ns, latency_ns)


@kernel
def _bin_of(time_ns: int) -> int:
    """The bin of a time: never outside the histogram; the last one takes all that is longer."""
    return int(min(max(time_ns // BIN_NS, 0), HISTOGRAM_BINS - 1))


@kernel
def account_until(
    block_address: int, deadline_ns: int, woke_ns: int, latency_ns: int, done_ns: int
) -> int:
    """Enter a tick that ended at `done_ns` into the block's figures. Returns its time in ns."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    tick_time_ns = done_ns - woke_ns
    block.wakeup_histogram[_bin_of(latency_ns)] += 1
    block.tick_time_histogram[_bin_of(tick_time_ns)] += 1
    if done_ns > deadline_ns + block.period_ns:
        block.late_ticks += 1
    store_release(block_address + _HEARTBEAT, done_ns)
    return int(tick_time_ns)


@kernel
def account(block_address: int, deadline_ns: int, woke_ns: int, latency_ns: int) -> int:
    """Enter a tick that ends now into the block's figures. Returns its time in ns."""
    return account_until(block_address, deadline_ns, woke_ns, latency_ns, now_ns())


def warm_up() -> None:
    """Compile the kernels of this shell and freeze them, so that no tick ever compiles anything."""
    scratch = np.zeros(1, BLOCK)
    wait_until(0, 0)
    account(address_of(scratch), 0, 0, 0)
    called: tuple[Any, ...] = (wait_until, account)
    for compiled in called:
        compiled.disable_compile()
