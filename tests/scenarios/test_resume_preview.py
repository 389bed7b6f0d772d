"""Resume does what its preview says: tick for tick, through the fade and on."""

from typing import Any

import numpy as np
import pytest

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import definition_from
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from app.rigs.resuming import resumed
from rtcore.codes import Opcode, Reply
from rtcore.memory.playing import read_playing
from rtcore.modes import Mode
from rtcore.virtual import Virtual

PERIOD_S = 250e-6
TICKS = 10_000

SAMPLES = [1000.0 * np.sin(0.7 * k) for k in range(200)]
TESTS: dict[str, tuple[list[dict[str, Any]], list[dict[str, Any]]]] = {
    "harmonic on a moving unit": (
        [{"kind": "harmonic", "mean_n": 500, "amplitude_n": 2000, "frequency_hz": 7.3, "cycles": 60}],
        [{"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 1.7, "duration_s": 20.0}],
    ),
    "layers": (
        [
            {
                "kind": "layers",
                "transition_s": 0.2,
                "repeats": 20,
                "layers": [
                    {"amplitude_n": 2000, "frequency_hz": 20, "cycles": 10},
                    {"mean_n": 3000, "amplitude_n": 1000, "frequency_hz": 31, "cycles": 10},
                ],
            }
        ],
        [],
    ),
    "ramps": (
        [{"kind": "ramp", "to_n": 9000, "duration_s": 4.0}, {"kind": "ramp", "to_n": 0, "duration_s": 4.0}],
        [{"kind": "ramp", "to_m": 0.01, "duration_s": 3.0}],
    ),
    "sweep": (
        [{"kind": "sweep", "amplitude_n": 1500, "from_hz": 5, "to_hz": 60, "duration_s": 12.0}],
        [],
    ),
    "samples": (
        [{"kind": "time_history", "samples_n": SAMPLES, "rate_hz": 50, "repeats": 5}],
        [],
    ),
}  # fmt: skip


def _running(name: str) -> Virtual:
    blocks, motion = TESTS[name]
    data = {"schema": 1, "name": name, "blocks": blocks, "motion": motion}
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    gains = gains_record(ControllerSettings())
    rig = Virtual(gains, interlocks_record(default_interlocks(), PERIOD_S))
    rig.bring_to_ready()
    assert rig.load_program(expand(definition)) == Reply.ACCEPTED
    assert rig.command(Opcode.START, 1) == Reply.ACCEPTED
    return rig


def _preview(rig: Virtual, held_ticks: int) -> tuple[Any, Any]:
    states = read_playing(rig.block)
    assert states is not None
    bank = int(rig.block.fields["active_program"])
    program = rig.block.fields["programs"][bank : bank + 1]
    return resumed(states, program, TICKS, PERIOD_S, held_ticks)


@pytest.mark.parametrize("name", TESTS)
@pytest.mark.parametrize("held_ticks", [0, 1, 777, 5000])
def test_a_resume_gives_the_previewed_setpoint_tick_for_tick(name: str, held_ticks: int) -> None:
    rig = _running(name)
    rig.advance(9_321)
    assert rig.command(Opcode.HOLD) == Reply.ACCEPTED
    rig.advance(2_500)
    assert rig.mode is Mode.HOLDING
    force, motion = _preview(rig, held_ticks)
    rig.advance(held_ticks)
    assert rig.command(Opcode.RESUME) == Reply.ACCEPTED
    first = rig.block.ring[(rig.tick - 1) % len(rig.block.ring)].copy()
    records = np.concatenate([np.array([first]), rig.advance(TICKS - 1)])
    assert records[-1]["mode"] == Mode.RUNNING
    assert np.array_equal(records["force_command_n"], force.astype(np.float32))
    assert np.array_equal(records["displacement_command_m"], motion.astype(np.float32))


def test_a_preview_moves_nothing() -> None:
    rig = _running("layers")
    rig.advance(5_000)
    rig.command(Opcode.HOLD)
    rig.advance(2_000)
    once, again = _preview(rig, 0), _preview(rig, 0)
    assert np.array_equal(once[0], again[0])
    assert np.ptp(once[0]) > 1000  # and it does show something


def test_a_hold_in_the_middle_of_its_fade_is_previewed_from_there() -> None:
    rig = _running("harmonic on a moving unit")
    rig.advance(6_000)
    rig.command(Opcode.HOLD)
    rig.advance(300)
    force, _ = _preview(rig, 0)
    rig.command(Opcode.RESUME)
    first = rig.block.ring[(rig.tick - 1) % len(rig.block.ring)]["force_command_n"]
    assert first == np.float32(force[0])
    assert np.array_equal(rig.advance(2000)["force_command_n"], force[1:2001].astype(np.float32))
