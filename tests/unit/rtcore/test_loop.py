"""The loop's arithmetic under a clock that the test moves: skips are counted, never a burst."""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, NamedTuple

import pytest

from rtcore.loop import account_until, keep_time
from rtcore.memory.layout import HISTOGRAM_BINS
from rtcore.memory.segment import Block, private_block

PERIOD_NS = 250_000
START_NS = 7_000_000_123


class Tick(NamedTuple):
    """What the cycle was told."""

    now_ns: int
    latency_ns: int
    tick_time_ns: int
    missed: int


@dataclass
class Machine:
    """A processor with its own clock: stopped in a wait, or with ticks as long as told."""

    ticks_wanted: int
    # Number of the wait → how late it ends; number of the tick → how long it lasts.
    stops_ns: dict[int, int] = field(default_factory=dict)
    lasts_ns: dict[int, int] = field(default_factory=dict)
    now_ns: int = START_NS
    waits: int = 0
    ticks: list[Tick] = field(default_factory=list)
    deadlines_ns: list[int] = field(default_factory=list)  # those that a tick served

    def __len__(self) -> int:
        return self.ticks_wanted - len(self.ticks)

    def wait(self, deadline_ns: int, margin_ns: int) -> int:
        self.now_ns = max(self.now_ns, deadline_ns) + self.stops_ns.get(self.waits, 300)
        self.waits += 1
        return self.now_ns

    def cycle(self, now_ns: int, latency_ns: int, tick_time_ns: int, missed: int) -> None:
        self.now_ns += self.lasts_ns.get(len(self.ticks), 9_000)
        self.ticks.append(Tick(now_ns, latency_ns, tick_time_ns, missed))

    def account(self, address: int, deadline_ns: int, woke_ns: int, latency_ns: int) -> int:
        self.deadlines_ns.append(deadline_ns)
        return self.now_ns - woke_ns

    def run(self) -> list[Tick]:
        keep_time(
            self,
            self.wait,
            self.cycle,
            self.account,
            block_address=0,
            start_ns=START_NS,
            period_ns=PERIOD_NS,
            margin_ns=60_000,
        )
        return self.ticks


def test_a_tick_a_period_each_told_of_its_own_latency_and_of_the_last_tick_time() -> None:
    ticks = Machine(3, stops_ns={1: 700}, lasts_ns={0: 5_000}).run()
    first_ns = START_NS + PERIOD_NS
    assert ticks == [
        Tick(first_ns + 300, 300, 0, 0),
        Tick(first_ns + PERIOD_NS + 700, 700, 5_000, 0),
        Tick(first_ns + 2 * PERIOD_NS + 300, 300, 9_000, 0),
    ]


@pytest.mark.parametrize(
    ("late_ns", "missed"),
    [
        (PERIOD_NS - 1, 0),
        (PERIOD_NS, 1),
        (1_000_000, 4),
        (1_100_000, 4),
        (10_000_000, 40),
        (500_000_000, 2000),
    ],
)
def test_a_late_wake_up_is_counted_once_and_its_deadlines_are_skipped(
    late_ns: int, missed: int
) -> None:
    machine = Machine(10, stops_ns={4: late_ns})
    ticks = machine.run()
    assert [tick.missed for tick in ticks] == [0, 0, 0, 0, missed, 0, 0, 0, 0, 0]
    assert ticks[4].latency_ns == late_ns, "the whole lateness is told, not what is left of it"


@pytest.mark.parametrize("late_ns", [1_000_000, 10_130_000, 500_000_000])
@pytest.mark.parametrize("stopped", ["in a wait", "in a tick"])
def test_no_burst_after_a_stop(stopped: str, late_ns: int) -> None:
    machine = Machine(50)
    (machine.stops_ns if stopped == "in a wait" else machine.lasts_ns)[20] = late_ns
    ticks = machine.run()
    served = machine.deadlines_ns
    assert all(0 <= t.now_ns - d < PERIOD_NS for t, d in zip(ticks, served, strict=True))
    assert all(later - sooner >= PERIOD_NS for sooner, later in pairwise(served))
    # Each deadline is served or missed: none is forgotten, none counted twice.
    assert len(ticks) + sum(t.missed for t in ticks) == (served[-1] - START_NS) // PERIOD_NS


def test_nothing_runs_once_the_flag_is_down() -> None:
    assert Machine(0).run() == []


@pytest.fixture
def block() -> Block:
    return private_block(PERIOD_NS, seconds=0.01)


def accounted(block: Block, *, latency_ns: int, tick_time_ns: int) -> Any:
    woke_ns = START_NS + latency_ns
    told = account_until(block.address, START_NS, woke_ns, latency_ns, woke_ns + tick_time_ns)
    assert told == tick_time_ns
    return block.fields


@pytest.mark.parametrize(
    ("time_ns", "expected_bin"),
    [(-5_000, 0), (0, 0), (999, 0), (1_000, 1), (998_999, 998), (999_000, 999), (10**12, 999)],
)
def test_times_fall_into_bins_of_a_microsecond_and_long_ones_into_the_last(
    block: Block, time_ns: int, expected_bin: int
) -> None:
    fields = accounted(block, latency_ns=time_ns, tick_time_ns=time_ns)
    for histogram in (fields["wakeup_histogram"], fields["tick_time_histogram"]):
        assert len(histogram) == HISTOGRAM_BINS
        assert histogram.sum() == histogram[expected_bin] == 1


@pytest.mark.parametrize(("tick_time_ns", "late"), [(249_000, 0), (249_001, 1), (900_000, 1)])
def test_a_tick_is_late_when_it_ends_after_the_next_deadline(
    block: Block, tick_time_ns: int, late: int
) -> None:
    assert accounted(block, latency_ns=1_000, tick_time_ns=tick_time_ns)["late_ticks"] == late


def test_the_heartbeat_is_the_end_of_the_tick(block: Block) -> None:
    fields = accounted(block, latency_ns=1_000, tick_time_ns=9_000)
    assert fields["loop_heartbeat_ns"] == START_NS + 10_000
