"""The faults that a simulated rig can be given, declared once: kind, what its amount means, its bounds.

Each acts behind the I/O boundary, on the plant or on its converters; neither loop nor app knows more of it
than its number. Taken back, it leaves no trace but what the plant itself went through.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from rtcore.compiled import kernel


class Fault(IntEnum):
    """What can be wrong."""

    LOAD_CELL_OPEN = 1
    LOAD_CELL_FROZEN = 2
    LOAD_CELL_SIGN = 3
    LOAD_CELL_NOISE = 4
    LOAD_CELL_NAN = 5
    LOAD_CELL_DRIFT = 6
    VALVE_HARD_OVER = 7
    VALVE_STUCK = 8
    VALVE_NULL_SHIFT = 9
    PUMP_LOSS = 10
    SPECIMEN_BROKEN = 11
    AIR_IN_OIL = 12
    LATE_TICKS = 13
    CHAIN_OPEN = 14
    LVT_FROZEN = 15
    LVDT_OPEN = 16


class FaultKind(NamedTuple):
    """One line of the table: an amount between `low` and `high`, in `unit`, 0 for none."""

    name: str
    amount: str
    unit: str
    low: float
    high: float
    default: float
    doc: str


def _present(name: str, doc: str) -> FaultKind:
    return FaultKind(name, "1 where it is there", "-", 1.0, 1.0, 1.0, doc)


FAULTS = {
    Fault.LOAD_CELL_OPEN: FaultKind(
        "Load cell open",
        "rail of the amplifier: +1 compression, -1 tension",
        "-",
        -1.0,
        1.0,
        1.0,
        "A wire of the load cell's bridge breaks: its amplifier goes to the rail.",
    ),
    Fault.LOAD_CELL_FROZEN: _present(
        "Load cell frozen", "The load cell's converter repeats the last code that it delivered."
    ),
    Fault.LOAD_CELL_SIGN: _present(
        "Load cell reversed", "The load cell's wires are exchanged: it reads the force negated."
    ),
    Fault.LOAD_CELL_NOISE: FaultKind(
        "Load cell noisy",
        "factor on its noise",
        "-",
        1.0,
        1000.0,
        500.0,
        "The load cell's screen is torn: its noise grows.",
    ),
    Fault.LOAD_CELL_NAN: _present(
        "Load cell no number", "The load cell's driver delivers NaN in place of a number."
    ),
    Fault.LOAD_CELL_DRIFT: FaultKind(
        "Load cell drifting",
        "rate",
        "N/s",
        -20e3,
        20e3,
        2000.0,
        "The load cell's zero wanders away at a constant rate.",
    ),
    Fault.VALVE_HARD_OVER: FaultKind(
        "Servovalve hard over",
        "where the spool is driven, share of its stroke",
        "-",
        -1.0,
        1.0,
        1.0,
        "The servovalve's electronics drive the spool to one place, whatever the command.",
    ),
    Fault.VALVE_STUCK: _present(
        "Servovalve stuck", "Dirt holds the servovalve's spool where it is, whatever the command."
    ),
    Fault.VALVE_NULL_SHIFT: FaultKind(
        "Servovalve's null shifted",
        "shift of the spool's null",
        "m",
        -2e-4,
        2e-4,
        4e-5,
        "The servovalve's null moves, as with an eroded land or a detuned torque motor.",
    ),
    Fault.PUMP_LOSS: _present(
        "Pump lost", "The pump delivers no more; the accumulator carries on while it lasts."
    ),
    Fault.SPECIMEN_BROKEN: _present(
        "Specimen broken", "The joint between the rig and the unit under test breaks."
    ),
    Fault.AIR_IN_OIL: _present(
        "Air in the oil", "5 % of the oil's volume is free air: the actuator becomes soft."
    ),
    Fault.LATE_TICKS: FaultKind(
        "Late ticks",
        "how long the I/O keeps the processor in each tick",
        "s",
        1e-4,
        0.05,
        0.02,
        "The I/O keeps the processor: deadlines are missed.",
    ),
    Fault.CHAIN_OPEN: _present(
        "Hard-wired chain open", "A contact of the hard-wired chain opens its input."
    ),
    Fault.LVT_FROZEN: _present(
        "LVT frozen", "The velocity transducer's converter repeats the last code that it delivered."
    ),
    Fault.LVDT_OPEN: FaultKind(
        "LVDT open",
        "rail of the demodulator: +1 or -1",
        "-",
        -1.0,
        1.0,
        1.0,
        "A wire of the LVDT breaks: its demodulator goes to the rail.",
    ),
}

# By `Fault`: what no rig goes beyond, whatever it is asked for.
KINDS = len(Fault) + 1
LOWEST, HIGHEST = np.zeros(KINDS), np.zeros(KINDS)
for _fault, _kind in FAULTS.items():
    LOWEST[_fault], HIGHEST[_fault] = _kind.low, _kind.high


@kernel
def amount_within(kind: int, asked: float) -> float:
    """The amount of a fault that is in force where this one is asked for; 0 stays 0."""
    return min(max(asked, LOWEST[kind]), HIGHEST[kind]) if asked != 0.0 else 0.0
