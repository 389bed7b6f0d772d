"""`forcerig bench unit_response`: the unit's own dynamic stiffness and position response, load on and off.

What is true of both is in the rig's parameters: k_TRA + jω·c_TRA, and a servo of second order. They are
read from what a real rig would have: load cell, LVT and LVDT, with their noise and their steps; the
stiffness from sines of force, the position response from the library's own test.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.response.point import ResponsePoint
from app.analysis.response.unit_under_test import servo
from app.conducting.responding import Responding
from app.definitions.definition import Definition
from app.definitions.library import library
from app.definitions.windows import windows
from bench.recorded import begin, make_test, ready_rig
from bench.report import Figure, progress, show
from rtcore.rig.parameters import RigParameters, load_rig
from rtcore.virtual import PERIOD_S

FREQUENCIES_HZ = (2.0, 5.0, 10.0, 20.0, 35.0, 50.0, 70.0, 100.0)
AMPLITUDE_N, MEAN_N = 5000.0, 10_000.0
POSITION_TEST = "unit-position-response"
WITHIN_PERCENT, WITHIN_DEG = 1.0, 1.0
Points = list[ResponsePoint]


def points_of(rig: RigParameters, definition: Definition, transfer: str) -> Points:
    """Run a test, and read a transfer from what was recorded of it."""
    virtual = ready_rig(rig, seed=5)
    begin(virtual, definition)
    first = virtual.block.ring[(virtual.tick - 1) % len(virtual.block.ring)].copy()
    ticks = windows(definition, 1 << 40).ticks
    responding = Responding(definition, PERIOD_S, rig=rig)
    responding.take(np.array([first]))
    responding.take(virtual.advance(ticks - 1))
    return [f.point for f in responding.points() if f.point.transfer == transfer]


def stiffness(rig: RigParameters, mean_n: float) -> tuple[Points, npt.NDArray[Any]]:
    """Dynamic stiffness at sines about a mean, and what it is."""
    response = {
        "kind": "frequency_response",
        "mean_n": mean_n,
        "amplitudes_n": [AMPLITUDE_N],
        "frequencies_hz": list(FREQUENCIES_HZ),
        "settle_cycles": 6,
        "measure_cycles": 40,
    }
    found = points_of(rig, make_test([response]), "stiffness")
    hz = np.array([p.frequency_hz for p in found])
    return found, rig.unit.k_tra + 2j * np.pi * hz * rig.unit.c_tra


def positions(rig: RigParameters) -> Iterator[tuple[Points, npt.NDArray[Any]]]:
    """Position response without load, then with one, and what it is."""
    found = points_of(rig, library()[POSITION_TEST], "position")
    for mean_n in (0.0, MEAN_N):
        points = [p for p in found if p.mean_n == mean_n]
        yield points, servo(rig, np.array([p.frequency_hz for p in points]))


def figures() -> Iterator[Figure]:
    """Each quantity with the load off and on."""
    rig = load_rig()
    for name, mean_n, what in (
        ("stiffness_unloaded", 0.0, "stiffness, no mean load"),
        ("stiffness_loaded", MEAN_N, f"stiffness, {MEAN_N / 1e3:g} kN mean"),
    ):
        progress(what)
        yield from compared(name, what, *stiffness(rig, mean_n))
    progress("position response")
    off, on = positions(rig)
    yield from compared("position_unloaded", "position response, no load", *off)
    yield from compared("position_loaded", f"position response, {MEAN_N / 1e3:g} kN held", *on)


def compared(name: str, what: str, points: Points, true: npt.NDArray[Any]) -> Iterator[Figure]:
    """The worst point, in % of the magnitude and in degrees."""
    said = np.array([p.gain * np.exp(1j * np.radians(p.phase_deg)) for p in points])
    apart = said / true
    percent, degrees = 100 * np.abs(np.abs(apart) - 1), np.abs(np.degrees(np.angle(apart)))
    note = f"worst of {len(points)}, {points[0].frequency_hz:g} to {points[-1].frequency_hz:g} Hz"
    for unit, values, limit, sign in (
        ("percent", percent, WITHIN_PERCENT, "%"),
        ("deg", degrees, WITHIN_DEG, "°"),
    ):
        yield Figure(f"{name}_{unit}", what, float(values.max()), sign, at_most=limit, note=note)


def main(as_json: bool) -> int:
    """Measure and print."""
    found = list(figures())
    about = [f"stiffness by sines of {AMPLITUDE_N:g} N, position by the test {POSITION_TEST}"]
    show("unit_response", found, [*about, "the rig as shipped"], as_json)
    return int(any(figure.met is False for figure in found))
