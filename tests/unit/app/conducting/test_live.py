"""The run under way followed through the ring: points as they settle, skips in time, and whoever must not conduct."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from app.analysis.response.point import ResponsePoint
from app.conducting.found import Found
from app.conducting.live import Known, LiveResponses
from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from app.link.commander import Answer
from app.link.life import Life
from app.link.refusals import as_refusal
from app.recording.bins import Columns
from rtcore.channels import CHANNELS
from rtcore.codes import Opcode, Reply
from rtcore.modes import Mode
from rtcore.rig.parameters import load_rig
from rtcore.virtual import Virtual
from tests.unit.app.conducting.responses import play, points_of, response_test

RUN = 7
LOOK = 80  # ticks: 20 ms
TEST = response_test(
    frequencies_hz=[20.0, 40.0, 80.0],
    measure_cycles=40,
    confidence={"gain_db": 0.05, "phase_deg": 0.5},
)
PLAIN = response_test(frequencies_hz=[20.0, 40.0, 80.0], measure_cycles=8)


class Rig:
    """A virtual rig that plays a test, with what follows it as beside a real loop."""

    def __init__(self, definition: Definition) -> None:
        self.virtual = Virtual(
            gains_record(ControllerSettings()),
            interlocks_record(default_interlocks(), RIG.period_s),
        )
        self.virtual.bring_to_ready()
        assert self.virtual.load_program(expand(definition)) == Reply.ACCEPTED
        self.life: Life | None = Life(self.virtual.block)
        self.asked: list[int] = []
        self.told: list[tuple[int, Found]] = []  # tick, point
        self.records: list[Any] = []
        self._definition = definition
        self.follower = self.follow()

    def follow(self, recorded: Any = None) -> LiveResponses:
        """Begin to follow it, as a console that has just been started."""
        known = Known(self._definition, load_rig(), recorded or (lambda tick: iter(())))
        follower = LiveResponses(self, lambda run: known, self._tell, RIG.period_s)
        follower.look()
        return follower

    def start(self, lease: int = 1) -> None:
        self.virtual.command(Opcode.TAKE_LEASE, lease=lease)
        assert self.virtual.command(Opcode.START, RUN) == Reply.ACCEPTED
        self._take(1)

    def advance(self, ticks: int) -> None:
        """So many ticks, looked at every 20 ms."""
        for _ in range(0, ticks, LOOK):
            self.records.append(self.virtual.advance(LOOK))
            self.follower.look()
            self.follower.tell()

    def finish(self) -> Any:
        """To the end of the run; its ticks."""
        while self.records[-1]["run"][-1] == RUN:
            self.advance(4000)
        every = np.concatenate(self.records)
        return every[every["run"] == RUN]

    def ask(
        self, opcode: Opcode, argument: int = 0, *, value: float = 0.0, lease: int | None = None
    ) -> Answer | Refusal:
        self.asked.append(argument)
        first = self.virtual.tick
        answer = Answer(self.virtual.command(opcode, argument, value, lease), self.virtual.tick - 1)
        self._take(self.virtual.tick - first)
        return as_refusal(opcode, answer) or answer

    def _take(self, ticks: int) -> None:
        """What has been played by a command."""
        slots = len(self.virtual.block.ring)
        at = np.arange(self.virtual.tick - ticks, self.virtual.tick) % slots
        self.records.append(self.virtual.block.ring[at].copy())

    def _tell(self, run_id: int, found: Found) -> None:
        assert run_id == RUN
        self.told.append((self.virtual.tick, found))


def assert_alike(points: list[ResponsePoint], others: list[ResponsePoint]) -> None:
    """The same but for the order in which sums were taken."""
    assert [point[:1] + point[2:5] for point in points] == [
        other[:1] + other[2:5] for other in others
    ]
    for point, other in zip(points, others, strict=True):
        assert point.gain == pytest.approx(other.gain, rel=1e-9)
        assert point.phase_deg == pytest.approx(other.phase_deg, abs=1e-6)
        assert point.cycles == other.cycles


@pytest.fixture
def rig() -> Rig:
    rig = Rig(TEST)
    rig.start()
    return rig


def test_it_conducts_as_the_virtual_rig_does(rig: Rig) -> None:
    records = rig.finish()
    expected = {point.frequency_hz: point for point in play(TEST).points}
    points = [f.point for f in rig.follower.points(RUN) if f.point.transfer == "force"]
    assert len(points) == len(expected) == 3
    for point in points:
        low, high = expected[point.frequency_hz].gain_95
        wide = high - low + point.gain_95.high - point.gain_95.low
        assert abs(point.gain - expected[point.frequency_hz].gain) <= wide
    assert abs(len(records) - len(play(TEST).records)) <= 3 * LOOK
    assert_alike(points, points_of(TEST, records))


def test_a_point_is_told_within_half_a_second_of_its_last_cycle() -> None:
    """In ticks: the client's frame goes out a thirtieth of a second later at most."""
    rig = Rig(PLAIN)
    rig.start()
    records = rig.finish()
    for hz in (20.0, 40.0, 80.0):
        of_point = [(tick, f) for tick, f in rig.told if f.point.frequency_hz == hz]
        whole = next(tick for tick, found in of_point if found.point.cycles == 8)
        counted = _last_tick_counted(records, hz)
        assert 0 < whole - counted <= 2 * LOOK
        assert {found.point.transfer for _, found in of_point} >= {"force", "plant", "stiffness"}


def _last_tick_counted(records: Any, hz: float) -> int:
    """The last tick of a point's eighth cycle, from the definition's own timing."""
    at = 0
    for other in (20.0, 40.0, 80.0):
        before = {20.0: 20.0, 40.0: 20.0, 80.0: 40.0}[other]
        blend_s = max(2 / before, 0.1)
        at += round((blend_s + 2 / other + 8 / other) / RIG.period_s)
        if other == hz:
            break
    return int(records["tick"][0]) + at - 1


def test_points_grow_cycle_by_cycle_and_the_newest_is_told_once() -> None:
    rig = Rig(PLAIN)
    rig.start()
    rig.finish()
    first = [f.point for _, f in rig.told if f.point.frequency_hz == 20.0]
    cycles = [point.cycles for point in first if point.transfer == "force"]
    assert cycles == sorted(cycles)
    assert set(cycles) == set(range(1, 9))
    assert len(first) == len(set(first))


def test_a_hold_in_the_middle_changes_no_point_and_asks_for_nothing(rig: Rig) -> None:
    rig.advance(2000)
    rig.virtual.command(Opcode.HOLD)
    asked = len(rig.asked)
    rig.advance(8000)
    assert rig.virtual.mode == Mode.HOLDING
    assert len(rig.asked) <= asked + 1  # what was on its way
    rig.virtual.command(Opcode.RESUME)
    rig.finish()
    points = [f.point for f in rig.follower.points(RUN) if f.point.transfer == "force"]
    expected = {point.frequency_hz: point for point in play(TEST).points}
    assert [point.frequency_hz for point in points] == [20.0, 40.0, 80.0]
    for point in points:
        assert point.gain == pytest.approx(expected[point.frequency_hz].gain, rel=0.01)


def test_once_command_has_passed_on_the_test_plays_its_full_length(rig: Rig) -> None:
    rig.advance(LOOK)
    rig.virtual.command(Opcode.TAKE_LEASE, lease=9)
    records = rig.finish()
    assert len(rig.asked) == 1  # refused once, and never asked again
    assert np.diff(records["program_tick"]).max() <= 2  # the tick of the command is not among these
    cycles = [point.cycles for point in points_of(TEST, records)]
    assert cycles == [40, 40, 40]


def test_without_anybody_that_follows_the_test_plays_its_full_length(rig: Rig) -> None:
    """As where the console dies."""
    rig.life = None
    records = rig.finish()
    assert rig.asked == []
    assert [point.cycles for point in points_of(TEST, records)] == [40, 40, 40]


def test_a_console_that_comes_later_goes_on_from_what_is_recorded(rig: Rig) -> None:
    rig.advance(3000)

    def recorded(before_tick: int) -> Iterator[Columns]:
        every = np.concatenate(rig.records)
        kept = every[(every["run"] == RUN) & (every["tick"] < before_tick)]
        yield {channel.name: kept[channel.name] for channel in CHANNELS}

    rig.follower = rig.follow(recorded)
    records = rig.finish()
    points = [f.point for f in rig.follower.points(RUN) if f.point.transfer == "force"]
    assert_alike(points, points_of(TEST, records))
    assert len(records) < 1.1 * len(play(TEST).records)


def test_progress_counts_points_and_the_time_that_is_left(rig: Rig) -> None:
    rig.advance(2400)
    found = rig.follower.progress(RUN)
    assert found is not None
    points, of, seconds_left = found
    assert 1 <= points <= of == 3
    assert seconds_left is not None
    assert 0 < seconds_left < 5
    assert rig.follower.progress(RUN + 1) is None
    assert rig.follower.points(RUN + 1) == []


def test_what_it_cannot_follow_leaves_the_run_alone() -> None:
    rig = Rig(TEST)

    def broken(run_id: int) -> Known | None:
        raise ValueError("the definition of the run cannot be read")

    rig.follower = LiveResponses(rig, broken, rig._tell, RIG.period_s)
    rig.follower.look()
    rig.start()
    rig.records.append(rig.virtual.advance(80))
    with pytest.raises(ValueError, match="cannot be read"):  # its thread logs it
        rig.follower.look()
    rig.follower.look()  # and goes on without that run
    rig.finish()
    assert rig.asked == []
