"""The loop's own check over a black box trips as the loop did; with a value changed it says what would have."""

from collections.abc import Callable
from pathlib import Path

import pytest

from app.db import Database
from app.errors import Refusal
from app.first_outs.replay_schemas import ReplayOut
from app.first_outs.replaying import replay
from rtcore.codes import Opcode
from rtcore.rig.faults import Fault
from tests.unit.app.first_outs.lived import SECOND, Lived


@pytest.fixture
def lived(database: Database, tmp_path: Path) -> Lived:
    return Lived(database, tmp_path)


def open_load_cell(lived: Lived) -> None:
    lived.start()
    lived.advance(SECOND)
    lived.inject(Fault.LOAD_CELL_OPEN)


def frozen_load_cell(lived: Lived) -> None:
    lived.start()
    lived.advance(3 * SECOND)
    lived.inject(Fault.LOAD_CELL_FROZEN)


def reversed_load_cell(lived: Lived) -> None:
    lived.start()
    lived.advance(SECOND)
    lived.inject(Fault.LOAD_CELL_SIGN)


def no_number(lived: Lived) -> None:
    lived.start()
    lived.advance(SECOND)
    lived.inject(Fault.LOAD_CELL_NAN)


def hard_over(lived: Lived) -> None:
    lived.start()
    lived.advance(SECOND)
    lived.inject(Fault.VALVE_HARD_OVER)


def lost_pump(lived: Lived) -> None:
    lived.start()
    lived.advance(SECOND)
    lived.inject(Fault.PUMP_LOSS)
    lived.advance(6 * SECOND)


def lost_pump_while_pressurising(lived: Lived) -> None:
    """Tripped by a detector that was violated long before the box begins."""
    lived.command(Opcode.RESET)
    lived.inject(Fault.PUMP_LOSS)
    lived.command(Opcode.PRESSURISE)
    lived.advance(17 * SECOND)


def open_lvdt_when_ready(lived: Lived) -> None:
    lived.bring_to_ready()
    lived.advance(SECOND)
    lived.inject(Fault.LVDT_OPEN)


SITUATIONS = (
    open_load_cell,
    frozen_load_cell,
    reversed_load_cell,
    no_number,
    hard_over,
    lost_pump,
    lost_pump_while_pressurising,
    open_lvdt_when_ready,
)


def replayed(lived: Lived, **changes: float | bool) -> ReplayOut:
    found = replay(*lived.kept(), {k.replace("__", "."): v for k, v in changes.items()})
    assert isinstance(found, ReplayOut), found
    return found


@pytest.mark.parametrize("happens", SITUATIONS, ids=lambda f: f.__name__)
def test_unchanged_it_trips_exactly_as_the_loop_did(
    lived: Lived, happens: Callable[[Lived], None]
) -> None:
    happens(lived)
    found = replayed(lived)
    left_out = {n.detector for n in found.not_replayed}
    recorded = [t for t in found.recorded if t.detector not in left_out]
    assert recorded
    told = [(t.tick, t.detector, t.action) for t in found.unchanged]
    assert told == [(t.tick, t.detector, t.action) for t in recorded]
    assert found.reproduces
    assert found.first_out is not None
    assert found.first_out.time_s == 0.0


def test_a_lower_threshold_trips_earlier(lived: Lived) -> None:
    reversed_load_cell(lived)
    as_it_was = replayed(lived)
    sooner = replayed(lived, velocity__threshold=0.02, velocity__persistence_s=0.0)
    assert as_it_was.first_out is not None
    assert sooner.first_out is not None
    assert sooner.first_out.detector == "velocity"
    assert sooner.first_out.time_s < 0
    assert "earlier" in sooner.text
    assert "interlocks.velocity.threshold at 0.02 instead of 0.4" in sooner.text


def test_without_the_detector_nothing_takes_the_load_off_in_that_tick(lived: Lived) -> None:
    lost_pump(lived)
    first = replayed(lived).first_out
    assert first is not None
    without = replayed(lived, **{f"{first.detector}__enabled": False})
    assert first.detector not in {t.detector for t in without.changed}
    assert without.first_out is None or without.first_out.time_s > 0
    assert "a re-run tells" in without.text


def test_what_the_recording_does_not_tell_is_refused_by_name(lived: Lived) -> None:
    open_load_cell(lived)
    found = replay(*lived.kept(), {"app_silence.threshold": 0.1})
    assert isinstance(found, Refusal)
    assert found.faults[0].path == "interlocks.app_silence"
    assert "how long the console was silent is not in the recording" in found.detail


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("force_eror.threshold", 1.0, "did you mean force_error?"),
        ("force_error.treshold", 1.0, "did you mean threshold?"),
        ("force_error.threshold", "much", "must be a number"),
        ("force_error.persistence_s", 1e3, "must be at most 60"),
    ],
)
def test_a_wrong_path_or_value_is_refused_by_path(
    lived: Lived, path: str, value: object, said: str
) -> None:
    open_load_cell(lived)
    found = replay(*lived.kept(), {path: value})
    assert isinstance(found, Refusal)
    assert said in found.detail
    assert found.faults[0].path == f"interlocks.{path}"
