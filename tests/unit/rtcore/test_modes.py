"""The state machine, over every state and event."""

import itertools

import pytest

from rtcore.modes import (
    NO_TRANSITION,
    TRANSITIONS,
    Event,
    Mode,
    is_closed_loop,
    is_pressurised,
    is_run,
    next_mode,
)


@pytest.mark.parametrize(("mode", "event"), list(itertools.product(Mode, Event)))
def test_every_state_and_event_does_what_the_table_says(mode: Mode, event: Event) -> None:
    assert next_mode(mode, event) == TRANSITIONS.get((mode, event), NO_TRANSITION)


def test_a_trip_works_everywhere_and_only_a_reset_leads_out() -> None:
    assert all(next_mode(mode, Event.TRIP) == Mode.TRIPPED for mode in Mode)
    out = {event for event in Event if next_mode(Mode.TRIPPED, event) not in (Mode.TRIPPED, -1)}
    assert out == {Event.RESET}
    assert next_mode(Mode.TRIPPED, Event.RESET) == Mode.OFF


def test_pressure_comes_by_command_alone() -> None:
    """From the states without supply, one command and no other event leads to pressure."""
    for mode, event in itertools.product((Mode.TRIPPED, Mode.OFF), Event):
        after = next_mode(mode, event)
        if after != NO_TRANSITION and is_pressurised(after):
            assert (mode, event) == (Mode.OFF, Event.PRESSURISE)


def test_a_run_begins_from_ready_alone() -> None:
    for mode, event in itertools.product(Mode, Event):
        if not is_run(mode) and next_mode(mode, event) == Mode.RUNNING:
            assert (mode, event) == (Mode.READY, Event.START)


def test_the_loop_is_closed_only_under_pressure() -> None:
    for mode in Mode:
        assert is_pressurised(mode) or not is_closed_loop(mode)
        assert is_closed_loop(mode) or not is_run(mode)
