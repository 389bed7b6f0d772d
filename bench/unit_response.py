"""`forcerig bench unit_response`: the unit's own dynamic stiffness and position response, load on and off.

What is true of both is in the rig's parameters: k_TRA + jω·c_TRA, and a servo of second order. They are
read from what a real rig would have: load cell, LVT and LVDT, with their noise and their steps.
"""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.response.stepped import SteppedSine, channels_of
from app.analysis.response.transfers import TRANSFERS
from app.analysis.response.unit_under_test import MEASURED, position_response
from app.analysis.walk import Walk
from app.definitions.windows import stretches, windows
from bench.recorded import begin, make_test, ready_rig
from bench.report import Figure, progress, show
from rtcore.rig.parameters import RigParameters, load_rig
from rtcore.virtual import PERIOD_S

FREQUENCIES_HZ = (2.0, 5.0, 10.0, 20.0, 35.0, 50.0, 70.0, 100.0)
AMPLITUDE_N, MEAN_N = 5000.0, 10_000.0
COMMAND_M = 0.004
MOTION_S = 12.0
WITHIN_PERCENT, WITHIN_DEG = 1.0, 1.0
Records = npt.NDArray[Any]


def run_test(rig: RigParameters, blocks: list[dict[str, Any]], motion: list[dict[str, Any]]) -> Any:
    """The definition and what was recorded of it."""
    definition = make_test(blocks, motion)
    virtual = ready_rig(rig, seed=5)
    begin(virtual, definition)
    first = virtual.block.ring[(virtual.tick - 1) % len(virtual.block.ring)].copy()
    ticks = windows(definition, 1 << 40).ticks
    records = np.concatenate([np.array([first]), virtual.advance(ticks - 1)])
    return definition, records


def stiffness(rig: RigParameters, mean_n: float, moving: bool) -> tuple[float, float]:
    """Worst error of dynamic stiffness in % and degrees."""
    response = {
        "kind": "frequency_response",
        "mean_n": mean_n,
        "amplitudes_n": [AMPLITUDE_N],
        "frequencies_hz": list(FREQUENCIES_HZ),
        "settle_cycles": 6,
        "measure_cycles": 40,
    }
    motion = {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 3.7, "duration_s": 60.0}
    definition, records = run_test(rig, [response], [motion] if moving else [])
    walk = Walk(stretches(definition), PERIOD_S, also=channels_of([MEASURED]))
    stepped = SteppedSine(PERIOD_S, {"force": TRANSFERS["force"]}, rig)
    for part in walk.take(records):
        stepped.take(part)
    found = [p for p in stepped.points() if p.transfer == "stiffness"]
    unit = rig.unit
    true = [unit.k_tra + 2j * np.pi * p.frequency_hz * unit.c_tra for p in found]
    said = [p.gain * np.exp(1j * np.radians(p.phase_deg)) for p in found]
    return worst(np.array(said), np.array(true))


def position(rig: RigParameters, force_n: float) -> tuple[float, float]:
    """Worst error of the position response in % and degrees, under a held force."""
    hold = {"kind": "hold", "force_n": force_n, "duration_s": len(FREQUENCIES_HZ) * MOTION_S + 2}
    motion = [
        {"kind": "harmonic", "amplitude_m": COMMAND_M * min(1.0, 7.5 / hz), "frequency_hz": hz}
        | {"duration_s": MOTION_S}
        for hz in FREQUENCIES_HZ
    ]
    _, records = run_test(rig, [hold], motion)
    said = []
    for i, hz in enumerate(FREQUENCIES_HZ):
        # Its own stretch of the motion, without what leads in and out.
        at = slice(round((i * MOTION_S + 2) / PERIOD_S), round(((i + 1) * MOTION_S - 1) / PERIOD_S))
        command, moved = (
            records[name][at] for name in ("displacement_command_m", "displacement_m")
        )
        curve = position_response(command, moved, PERIOD_S, np.array([hz]))
        said.append(curve.gain[0])
    s = 2j * np.pi * np.array(FREQUENCIES_HZ)
    w, zeta = rig.unit.omega_t_rad_s, rig.unit.zeta_t
    return worst(np.array(said), w**2 / (s**2 + 2 * zeta * w * s + w**2))


def worst(said: npt.NDArray[Any], true: npt.NDArray[Any]) -> tuple[float, float]:
    """In % of the magnitude, and in degrees."""
    apart = said / true
    return (
        float(100 * np.max(np.abs(np.abs(apart) - 1))),
        float(np.max(np.abs(np.degrees(np.angle(apart))))),
    )


def figures() -> Iterator[Figure]:
    """Each quantity with the load on and off."""
    rig = load_rig()
    for name, what, found in (
        ("stiffness_unloaded", "stiffness, no mean load", partial(stiffness, rig, 0.0, False)),
        ("stiffness_loaded", "stiffness, 10 kN mean", partial(stiffness, rig, MEAN_N, False)),
        ("stiffness_moving", "stiffness, the unit moving", partial(stiffness, rig, 0.0, True)),
        ("position_unloaded", "position response, no load", partial(position, rig, 0.0)),
        ("position_loaded", "position response, 10 kN held", partial(position, rig, MEAN_N)),
    ):
        progress(what)
        percent, degrees = found()
        low, high = FREQUENCIES_HZ[0], FREQUENCIES_HZ[-1]
        note = f"worst of {low:g} to {high:g} Hz"
        yield Figure(f"{name}_percent", what, percent, "%", at_most=WITHIN_PERCENT, note=note)
        yield Figure(f"{name}_deg", what, degrees, "°", at_most=WITHIN_DEG, note=note)


def main(as_json: bool) -> int:
    """Measure and print."""
    found = list(figures())
    show("unit_response", found, [f"sines of {AMPLITUDE_N:g} N; the rig as shipped"], as_json)
    return int(any(figure.met is False for figure in found))
