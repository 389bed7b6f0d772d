"""Figures of the balances: over runs of the very tick, and with bugs planted in the plant."""

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np

from bench.balances import Balance, Fault, balance
from bench.recorded import (
    Floats,
    Recording,
    begin,
    make_test,
    quiet_rig,
    ready_rig,
    record,
    virtual_rig,
)
from bench.references import PERIOD_S
from bench.report import Figure
from rtcore.codes import Opcode
from rtcore.modes import Mode
from rtcore.rig.constants import plant_constants

LIMIT = 1e-6  # of throughput
PPM = 1e6
BOOKS = Balance._fields

# Which books a planted bug shows in. No one of the three sees them all.
SEEN_IN = {
    Fault.FLOW_FROM_NOWHERE: ("oil", "energy"),
    Fault.ORIFICE_OFF_ITS_LAW: ("energy",),
    Fault.OIL_TOO_STIFF: ("oil", "energy"),
    Fault.AREA_OFF_ON_ONE_SIDE: ("oil", "energy"),
    Fault.FRICTION_DRIVES: ("energy",),
    Fault.NO_REACTION_ON_BODY: ("momentum",),
    Fault.CELL_WITHOUT_REACTION: ("energy", "momentum"),
}


class Stretch(NamedTuple):
    """A part of a run."""

    what: str
    before: Floats
    inputs: Floats
    states: Floats


@cache
def moving() -> Stretch:
    """2 kN at 50 Hz for a second while the unit moves 2 mm at 4 Hz."""
    test = make_test(
        [{"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 50, "duration_s": 2}],
        [{"kind": "harmonic", "amplitude_m": 0.002073, "frequency_hz": 4, "duration_s": 2}],
    )
    virtual = ready_rig(quiet_rig())
    begin(virtual, test)
    return _stretch("2 kN at 50 Hz, unit moving", record(virtual, round(1.0 / PERIOD_S)))


@cache
def saturating() -> Stretch:
    """A step of 30 kN, which drives the valve into its stops."""
    virtual = ready_rig(quiet_rig())
    begin(virtual, make_test([{"kind": "step", "to_n": 30_000, "hold_s": 1}]))
    return _stretch("step of 30 kN", record(virtual, round(0.25 / PERIOD_S)))


@cache
def pressurised() -> Stretch:
    """From no pressure to full, and bled again."""
    virtual = virtual_rig(quiet_rig())
    virtual.command(Opcode.RESET)
    virtual.command(Opcode.PRESSURISE)
    up = record(virtual, round(2.5 / PERIOD_S))
    if virtual.mode is not Mode.READY:
        raise RuntimeError(f"the rig is not ready but {virtual.mode.name.lower()}")
    held = virtual.io.world["u"].copy()
    virtual.command(Opcode.DEPRESSURISE)  # takes a tick of its own
    between = virtual.io.world["y"].copy()
    down = record(virtual, round(1.0 / PERIOD_S))
    inputs = np.concatenate((up.inputs, held[None], down.inputs))
    states = np.concatenate((up.states, between[None], down.states))
    return Stretch("pressurised and bled", up.before, inputs, states)


def _stretch(what: str, run: Recording) -> Stretch:
    return Stretch(what, run.before, run.inputs, run.states)


def of_equations(stretch: Stretch, fault: Fault = Fault.NONE) -> Balance:
    """Of the equations of motion alone, integrated finely."""
    plant = plant_constants(quiet_rig())
    return balance(plant, stretch.before, stretch.inputs, fault=fault)


def of_tick(stretch: Stretch) -> Balance:
    """Of the loop's own integrator: what its states have lost."""
    plant = plant_constants(quiet_rig())
    return balance(plant, stretch.before, stretch.inputs, stretch.states, steps=16)


def figures() -> Iterator[Figure]:
    """Balances, then planted bugs."""
    for stretch in (moving(), saturating(), pressurised()):
        yield from _of(stretch.what, of_equations(stretch))
    for stretch in (moving(), saturating()):
        yield from _of(f"tick's own states, {stretch.what}", of_tick(stretch))
    for fault, books in SEEN_IN.items():
        found = of_equations(moving(), fault)
        for book in BOOKS:
            yield _planted(fault, book, getattr(found, book), book in books)


def _of(what: str, found: Balance) -> Iterator[Figure]:
    for book, share in zip(BOOKS, found, strict=True):
        name = f"balance_{_key(what)}_{book}_ppm"
        note = f"{share:.1e} of throughput"
        yield Figure(name, f"{book}: {what}", share * PPM, "ppm", at_most=LIMIT * PPM, note=note)


def _planted(fault: Fault, book: str, share: float, seen: bool) -> Figure:
    words = fault.name.lower().replace("_", " ")
    name = f"planted_{fault.name.lower()}_{book}_ppm"
    note = f"{share:.1e} of throughput, {'must' if seen else 'cannot'} be seen here"
    limit = {"at_least": LIMIT * PPM} if seen else {"at_most": LIMIT * PPM}
    return Figure(name, f"{book}: {words}", share * PPM, "ppm", note=note, **limit)


def _key(what: str) -> str:
    return what.replace(",", "").replace(" ", "_").lower()
