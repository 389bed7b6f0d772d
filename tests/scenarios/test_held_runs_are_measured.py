"""A run that was held is measured as if it had not been: what was held is no data."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from app.analysis.walk import Walk
from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.definitions.windows import stretches
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from app.prediction.judgement import judge_run
from rtcore.codes import Opcode, Reply
from rtcore.virtual import Virtual

HARMONIC = {"kind": "harmonic", "amplitude_n": 1000, "frequency_hz": 20, "cycles": 30}


def _definition() -> Definition:
    ramp = {"kind": "ramp", "to_n": 500, "rate_n_s": 1000}
    definition = definition_from({"schema": 1, "name": "held", "blocks": [ramp, HARMONIC]})
    assert isinstance(definition, Definition), definition.detail
    return definition


def _records(definition: Definition, holds: list[tuple[int, int]]) -> npt.NDArray[Any]:
    """All ticks of a run that is held: (ticks before the hold, ticks held) after one another."""
    interlocks = interlocks_record(default_interlocks(), RIG.period_s)
    virtual = Virtual(gains_record(ControllerSettings()), interlocks)
    virtual.bring_to_ready()
    assert virtual.load_program(expand(definition)) == Reply.ACCEPTED
    first = virtual.tick
    parts = [_commanded(virtual, Opcode.START, 1)]
    for before, held in holds:
        parts.append(virtual.advance(before))
        parts.append(_commanded(virtual, Opcode.HOLD, 0))
        parts.append(virtual.advance(held))
        parts.append(_commanded(virtual, Opcode.RESUME, 0))
    parts.append(virtual.advance(round(outline(definition).duration_s / RIG.period_s) + 4000))
    records = np.concatenate(parts)
    assert np.array_equal(records["tick"], first + np.arange(len(records)))
    of_the_run: npt.NDArray[Any] = records[records["run"] == 1]
    return of_the_run


def _commanded(virtual: Virtual, opcode: Opcode, argument: int) -> npt.NDArray[Any]:
    """Give a command; the record of the tick that obeyed it."""
    assert virtual.command(opcode, argument) == Reply.ACCEPTED
    ring = virtual.block.ring
    obeyed: npt.NDArray[Any] = ring[[(virtual.tick - 1) % len(ring)]]
    return obeyed


def test_every_tick_of_the_program_is_found_once_and_in_its_place() -> None:
    definition = _definition()
    whole = _parts(definition, _records(definition, []))
    held = _records(definition, [(900, 3000), (1500, 20), (2000, 1500)])
    assert len(held) > len(whole["positions"]) + 4500
    found = _parts(definition, held)
    ticks = round(outline(definition).duration_s / RIG.period_s)
    assert found["positions"].tolist() == list(range(ticks))
    assert whole["positions"].tolist() == list(range(ticks))
    # after a hold the oscillator has run on, so only the mean and the count are where they were
    assert np.array_equal(found["cycle"], whole["cycle"])
    assert np.array_equal(found["force_command_n"][:2000], whole["force_command_n"][:2000])
    assert np.count_nonzero(found["counted"]) == 30 * 200


def test_a_held_run_measures_the_same_amplitude_and_phase() -> None:
    definition = _definition()
    expected = judge_run(definition, _records(definition, []), RIG.period_s).measurements
    held = _records(definition, [(2900, 3000), (1500, 20), (2000, 1500)])
    values = judge_run(definition, held, RIG.period_s).measurements
    assert values["cycles"] == expected["cycles"] == 30
    for name in ("amplitude_n", "mean_n", "mean_peak_n", "mean_valley_n"):
        assert values[name] == pytest.approx(expected[name], rel=0.01, abs=5), name
    assert values["phase_deg"] == pytest.approx(expected["phase_deg"], abs=0.5)


def _parts(definition: Definition, records: npt.NDArray[Any]) -> dict[str, npt.NDArray[Any]]:
    """Where each tick is in the program, whether it counts, and two channels."""
    parts = list(Walk(stretches(definition), RIG.period_s).take(records))
    gathered = {
        name: np.concatenate([part.columns[name] for part in parts])
        for name in ("cycle", "force_command_n")
    }
    gathered["positions"] = np.concatenate([part.positions for part in parts])
    counted = [np.full(len(part.positions), part.stretch.counts) for part in parts]
    return gathered | {"counted": np.concatenate(counted)}
