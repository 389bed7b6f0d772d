"""Of each command, in each mode, what the console says must agree with what the loop would do."""

import pytest

from app.rigs.reasons import LOST, Situation, reasons
from rtcore.modes import TRANSITIONS, Event, Mode

BY_COMMAND = {
    "pressurise": Event.PRESSURISE,
    "depressurise": Event.DEPRESSURISE,
    "start": Event.START,
    "hold": Event.HOLD,
    "resume": Event.RESUME,
}


@pytest.mark.parametrize("mode", Mode)
@pytest.mark.parametrize("command", BY_COMMAND)
def test_what_may_be_given_is_what_the_loop_accepts(mode: Mode, command: str) -> None:
    reason = getattr(reasons(Situation(mode, None, 2e7)), command)
    assert (reason is None) == ((mode, BY_COMMAND[command]) in TRANSITIONS)


@pytest.mark.parametrize("mode", Mode)
def test_stop_may_always_be_given(mode: Mode) -> None:
    assert reasons(Situation(mode, "Force 56,000 N, limit 55,000 N", 2e7)).stop is None


@pytest.mark.parametrize("command", ["pressurise", "start", "resume"])
def test_what_is_latched_is_to_be_reset_first(command: str) -> None:
    modes = {"pressurise": Mode.OFF, "start": Mode.READY, "resume": Mode.HOLDING}
    now = Situation(modes[command], "Force error 6,120 N for 50 ms, limit 6,000 N", 2e7)
    reason = "Press Reset first: Force error 6,120 N for 50 ms, limit 6,000 N"
    assert getattr(reasons(now), command) == reason
    assert reasons(now).reset is None


def test_too_little_pressure_is_told_in_bar() -> None:
    told = reasons(Situation(Mode.PRESSURISING, None, 92e5)).start
    assert told == "Cannot start: supply pressure 92 bar, 190 bar needed"


def test_without_a_loop_nothing_may_be_given() -> None:
    told = reasons(Situation(None, None, float("nan"))).model_dump()
    assert set(told.values()) == {LOST}
