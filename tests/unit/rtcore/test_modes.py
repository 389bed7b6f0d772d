"""The state machine, over every state and event."""

import itertools

import pytest

from rtcore.modes import (
    NO_TRANSITION,
    Event,
    Mode,
    is_closed_loop,
    is_pressurised,
    is_run,
    next_mode,
)

# What every event does in every state, written out once more, by the architecture: · where it means nothing.
MATRIX = """
                  tripped  off           pressurising  ready     running   holding   stopping
RESET             off      ·             ·             ·         ·         ·         ·
PRESSURISE        ·        pressurising  ·             ·         ·         ·         ·
PRESSURE_REACHED  ·        ·             ready         ·         ·         ·         ·
START             ·        ·             ·             running   ·         ·         ·
HOLD              ·        ·             ·             ·         holding   ·         ·
RESUME            ·        ·             ·             ·         ·         running   ·
STOP              ·        ·             off           ·         stopping  stopping  stopping
STOPPED           ·        ·             ·             ·         ·         ·         ready
DEPRESSURISE      ·        ·             off           off       ·         ·         ·
TRIP              tripped  tripped       tripped       tripped   tripped   tripped   tripped
"""


def written_out() -> dict[tuple[str, str], str]:
    """(event, state) → state after it, all lower case but the events."""
    states, *rows = (line.split() for line in MATRIX.strip().splitlines())
    return {
        (event, state): after
        for event, *afters in rows
        for state, after in zip(states, afters, strict=True)
    }


def test_every_event_in_every_state_does_what_the_architecture_says() -> None:
    expected = written_out()
    assert len(expected) == len(Mode) * len(Event)
    for mode, event in itertools.product(Mode, Event):
        after = next_mode(mode, event)
        word = "·" if after == NO_TRANSITION else Mode(after).name.lower()
        assert word == expected[event.name, mode.name.lower()], (mode, event)


def test_states_and_events_are_numbered_as_recordings_have_them() -> None:
    names = "TRIPPED OFF PRESSURISING READY RUNNING HOLDING STOPPING"
    assert [mode.name for mode in sorted(Mode)] == names.split()
    assert sorted(Mode) == list(range(7))
    assert sorted(Event) == list(range(10))


@pytest.mark.parametrize("mode", Mode)
def test_what_a_state_is(mode: Mode) -> None:
    assert is_pressurised(mode) == (mode not in (Mode.TRIPPED, Mode.OFF))
    assert is_closed_loop(mode) == (mode in (Mode.READY, Mode.RUNNING, Mode.HOLDING, Mode.STOPPING))
    assert is_run(mode) == (mode in (Mode.RUNNING, Mode.HOLDING, Mode.STOPPING))


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
