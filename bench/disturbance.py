"""What a moving unit adds to the force: a run minus the same run without the motion."""

from functools import cache
from typing import NamedTuple

import numpy as np

from app.controller.settings import ControllerSettings
from bench.recorded import Floats, begin, make_test, ready_rig, states_of, true_force
from bench.references import PERIOD_S
from bench.sines import decibels, fundamental
from rtcore.modes import Mode
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import X_T

LOAD_N, LOAD_HZ = 2000.0, 50.0
MOTION_HZ = 4.0
COMMAND_M = 2.0730e-3  # the unit's servo makes 2.000 mm of it at 4 Hz
FROM_S, CYCLES = 1.5, 12  # whole periods of the motion, and so of the load


class Run(NamedTuple):
    """(n,) true force and load cell (N), and the unit's output (m), over whole periods."""

    force_n: Floats
    read_n: Floats
    output_m: Floats


@cache
def moved(compensator: str | None, moving: bool, seed: int = 1) -> Run:
    """A run of the shipped rig; without a compensator's name the compensation is off."""
    ticks = round(CYCLES / MOTION_HZ / PERIOD_S)
    lasts_s = FROM_S + ticks * PERIOD_S + 0.5
    load = {"kind": "harmonic", "amplitude_n": LOAD_N, "frequency_hz": LOAD_HZ}
    motion = {"kind": "harmonic", "amplitude_m": COMMAND_M, "frequency_hz": MOTION_HZ}
    test = make_test(
        [load | {"duration_s": lasts_s}],
        [motion | {"duration_s": lasts_s}] if moving else [],
        compensation="on" if compensator else "off",
    )
    rig = load_rig()
    settings = ControllerSettings.model_validate({"compensator": compensator or "COMP4"})
    virtual = ready_rig(rig, settings, seed)
    begin(virtual, test)
    virtual.advance(round(FROM_S / PERIOD_S))
    records, states = states_of(virtual, ticks)
    if virtual.mode is not Mode.RUNNING:
        raise RuntimeError(f"{compensator}: {virtual.mode.name.lower()}")
    return Run(true_force(rig, states), records["force_n"].astype(np.float64), states[:, X_T])


def disturbance(compensator: str | None) -> Floats:
    """(n,) N. Both runs have the same noise at their converters."""
    return moved(compensator, True).force_n - moved(compensator, False).force_n


def rms(values: Floats) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def fall_db(compensator: str) -> float:
    """By how much the line at the motion's frequency falls."""
    lines = [fundamental(disturbance(c), MOTION_HZ, PERIOD_S) for c in (None, compensator)]
    return decibels(lines[0] / lines[1])
