"""What the loop reports, in words for the operator."""

import math

import numpy as np
import pytest

from app.link.events import EventReader
from app.link.words import trip_code, trip_text
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import DETECTOR, Action, Comparison, Quantity
from rtcore.modes import Mode
from tests.written_block import WrittenBlock

PERIOD_NS = 250_000


def detector(quantity: Quantity, comparison: Comparison, ticks: int = 1) -> np.void:
    found: np.void = np.zeros(1, DETECTOR)[0]
    found["quantity"], found["comparison"], found["action"] = quantity, comparison, Action.STOP
    found["persistence_ticks"] = ticks
    return found


@pytest.mark.parametrize(
    ("quantity", "comparison", "ticks", "value", "limit", "code", "text"),
    [
        (
            *(Quantity.FORCE_ERROR_N, Comparison.MAGNITUDE_ABOVE, 200, -6120.4, 6000.0),
            *("force_error", "Force error 6,120 N for 50 ms, limit 6,000 N"),
        ),
        (
            *(Quantity.SUPPLY_PRESSURE_PA, Comparison.BELOW, 200, 14.2e6, 15e6),
            *("supply_pressure", "Supply pressure 142 bar for 50 ms, limit at least 150 bar"),
        ),
        (
            *(Quantity.DISPLACEMENT_M, Comparison.MAGNITUDE_ABOVE, 1, 0.0324, 0.032),
            *("displacement", "Displacement 32.4 mm, limit 32.0 mm"),
        ),
        (
            *(Quantity.VELOCITY_M_S, Comparison.ABOVE, 20, -0.31, 0.3),
            *("velocity", "Velocity -0.31 m/s for 5 ms, limit 0.30 m/s"),
        ),
        (
            *(Quantity.FORCE_N, Comparison.MAGNITUDE_ABOVE, 1, math.nan, 55e3),
            *("force", "Force not a number, limit 55,000 N"),
        ),
        (
            *(Quantity.APP_SILENCE_S, Comparison.ABOVE, 1, 0.50025, 0.5),
            *("app_silence", "Console silent for 0.50 s, limit 0.50 s"),
        ),
    ],
)
def test_a_trip_says_what_was_seen_and_what_was_allowed(
    quantity: Quantity,
    comparison: Comparison,
    ticks: int,
    value: float,
    limit: float,
    code: str,
    text: str,
) -> None:
    watching = detector(quantity, comparison, ticks)
    assert trip_code(watching) == code
    assert trip_text(watching, value, limit, PERIOD_NS) == text


def test_every_event_has_words() -> None:
    loop = WrittenBlock()
    loop.ticks(8)
    for mode in Mode:
        loop.go(mode)
    for opcode in Opcode:
        loop.obey(opcode)
    for reply in Reply:
        loop.obey(Opcode.START, reply)
    loop.report(EventKind.BLOCK, 2)
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.report(EventKind.DEADLINES_MISSED, 3, 750_000.0)
    loop.trip(31, 1.0, 1.0)
    events = EventReader(loop.life()).read()
    assert len(events) == len(Mode) + len(Opcode) + len(Reply) + 4
    assert all(event.text and event.code for event in events)
    assert {event.time_s for event in events} == {0.002}
    words = {event.text for event in events}
    assert {"Running", "Adopt program", "Block 3", "3 deadlines missed, up to 0.8 ms late"} <= words
    refused = [event.text for event in events if event.kind == "refusal"]
    assert len(refused) == len(Reply) - 1
    assert "Start refused: cause present" in refused


def test_events_are_read_once() -> None:
    loop = WrittenBlock()
    reader = EventReader(loop.life())
    loop.go(Mode.OFF)
    assert [event.text for event in reader.read()] == ["Off"]
    assert reader.read() == []
