"""Runs of the very tick on the virtual clock, with the plant's inputs and states kept."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import definition_from
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from rtcore.codes import Opcode, Reply
from rtcore.rig.parameters import RigParameters, rig_from
from rtcore.rig.plant import INPUTS, STATES, V_1, V_R, X_1, X_R
from rtcore.virtual import PERIOD_S, Virtual

Floats = npt.NDArray[np.float64]
Blocks = Sequence[Mapping[str, Any]]
NO_NOISE = {"force_noise_n": 0.0, "velocity_noise_m_s": 0.0}


@dataclass(frozen=True)
class Recording:
    """Some ticks of a rig: the state before them, the inputs held in each, the state after each.

    `before` (STATES,), `inputs` (n, INPUTS), `states` (n, STATES), `records` (n,) TELEMETRY.
    """

    before: Floats
    inputs: Floats
    states: Floats
    records: npt.NDArray[Any]


def quiet_rig(overrides: Mapping[str, Any] | None = None) -> RigParameters:
    """The shipped rig without noise at its converters, which keep their 16 bits."""
    over = dict(overrides or {})
    return rig_from(over | {"sensors": NO_NOISE | over.get("sensors", {})})


def make_test(
    blocks: Blocks, motion: Blocks = (), compensation: str = "auto", name: str = "Benchmark"
) -> Definition:
    """A test definition. Raises ValueError where it is refused."""
    data = {
        "schema": 1,
        "name": name,
        "blocks": list(blocks),
        "motion": list(motion),
        "controller": {"compensation": compensation},
    }
    definition = definition_from(data)
    if not isinstance(definition, Definition):
        raise ValueError(f"{name}: {definition}")
    return definition


def virtual_rig(
    rig: RigParameters, controller: ControllerSettings | None = None, seed: int = 1
) -> Virtual:
    """A rig as the loop begins, supply off. A sensor without noise is not taken for a frozen one."""
    gains = gains_record(controller or ControllerSettings())
    interlocks = interlocks_record(default_interlocks(), PERIOD_S)
    return Virtual(gains, interlocks, rig, seed, PERIOD_S, {"frozen_ticks": 0})


def ready_rig(
    rig: RigParameters, controller: ControllerSettings | None = None, seed: int = 1
) -> Virtual:
    """A rig that is pressurised and has come to rest."""
    virtual = virtual_rig(rig, controller, seed)
    virtual.bring_to_ready()
    virtual.advance(round(1.0 / PERIOD_S))
    return virtual


def begin(virtual: Virtual, definition: Definition) -> None:
    """Load a test and run its first tick. Raises RuntimeError where it is refused."""
    for reply in (virtual.load_program(expand(definition)), virtual.command(Opcode.START, 1)):
        if reply is not Reply.ACCEPTED:
            raise RuntimeError(f"{definition.name} was refused: {reply.name.lower()}")


def record(virtual: Virtual, ticks: int) -> Recording:
    """Advance tick by tick, and keep what a replay needs."""
    world = virtual.io.world
    before = world["y"].copy()
    inputs, states = np.empty((ticks, INPUTS)), np.empty((ticks, STATES))
    records = []
    for k in range(ticks):
        inputs[k] = world["u"]
        records.append(virtual.advance(1))
        states[k] = world["y"]
    return Recording(before, inputs, states, np.concatenate(records))


def states_of(virtual: Virtual, ticks: int) -> tuple[npt.NDArray[Any], Floats]:
    """Advance at full speed; (n,) TELEMETRY and (n, STATES)."""
    virtual.keep_states = True
    records = virtual.advance(ticks)
    virtual.keep_states = False
    return records, virtual.states


def true_force(rig: RigParameters, states: Floats) -> Floats:
    """(n,) force in the load cell (N) in (n, STATES) states, before the load cell's own chain."""
    s = rig.structure
    spring = s.k_lc * (states[:, X_R] - states[:, X_1])
    return np.asarray(spring + s.c_lc * (states[:, V_R] - states[:, V_1]))
