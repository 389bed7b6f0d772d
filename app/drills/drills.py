"""The drills as a table: each fault, when it can be given, and what must follow.

The reactions are those of the detectors that ship with forcerig. Under another table a drill may fail: then
that table lets through what the shipped one does not.
"""

from typing import NamedTuple

from rtcore.rig.faults import FAULTS, Fault, FaultKind

AT_ONCE_S = 1e-3  # the tick that sees it, and some more for what a slower sensor needs
FROZEN_S = 0.06  # a sensor is frozen that repeats itself for 50 ms
QUIET_S = 3.0  # for how long nothing may trip where nothing must
JUMP = ("force", "force_ahead", "force_rate", "load_cell")


class Reaction(NamedTuple):
    """Which detectors may be the first-out and how soon; none where the load must stay on all the while."""

    first_outs: tuple[str, ...]
    within_s: float
    sees: str  # by the operator


class Drill(NamedTuple):
    """What must follow a fault while the rig is ready, and in a test; None where it cannot be given then."""

    fault: Fault
    ready: Reaction | None
    test: Reaction | None

    @property
    def name(self) -> str:
        """As programs know it."""
        return self.fault.name.lower()

    @property
    def kind(self) -> FaultKind:
        """What the fault is, and what amounts of it there are."""
        return FAULTS[self.fault]


def _both(fault: Fault, *reaction: tuple[str, ...] | float | str) -> Drill:
    """A drill with one reaction, whatever the rig does."""
    same = Reaction(*reaction)  # type: ignore[arg-type]
    return Drill(fault, same, same)


DRILLS = (
    _both(
        Fault.LOAD_CELL_OPEN,
        JUMP,
        AT_ONCE_S,
        "The force jumps to the end of its range and the rig trips in the same tick; the first-out says: saturated.",
    ),
    _both(
        Fault.LOAD_CELL_FROZEN,
        ("load_cell",),
        FROZEN_S,
        "The force stands still to the last digit, then the rig trips on its load cell.",
    ),
    Drill(
        Fault.LOAD_CELL_SIGN,
        Reaction(
            ("load_cell",),
            0.5,
            "The force runs away from zero until load cell and chambers contradict each other.",
        ),
        Reaction(
            (*JUMP, "force_error"),
            0.1,
            "The force changes its sign at once, or runs away; the rig trips before it is large.",
        ),
    ),
    _both(
        Fault.LOAD_CELL_NOISE,
        JUMP,
        0.5,
        "The force becomes a broad band, and changes faster than any load can.",
    ),
    _both(
        Fault.LOAD_CELL_NAN,
        JUMP,
        AT_ONCE_S,
        "The force has no value any more, and the rig trips in the same tick.",
    ),
    _both(
        Fault.LOAD_CELL_DRIFT,
        ("load_cell", "twin_residual", "force_error"),
        5.0,
        "Nothing at first: the loop follows its load cell, until that and the chambers are 5 kN apart.",
    ),
    _both(
        Fault.VALVE_HARD_OVER,
        (*JUMP, "lvt", "velocity", "twin_residual", "valve_spool"),
        0.1,
        "The force runs to what the supply can push, and falls with the supply's pressure.",
    ),
    Drill(
        Fault.VALVE_STUCK,
        None,
        Reaction(
            ("twin_residual", "force_error", *JUMP, "valve_saturation", "valve_spool"),
            3.0,
            "The spool stands still while its command moves, and the force leaves its setpoint.",
        ),
    ),
    Drill(
        Fault.VALVE_NULL_SHIFT,
        None,
        Reaction(
            ("twin_residual",),
            0.5,
            "The loop makes up for it within a few cycles; the model, given the same command, goes elsewhere.",
        ),
    ),
    Drill(
        Fault.PUMP_LOSS,
        None,
        Reaction(
            ("supply_pressure", "twin_residual"),
            20.0,
            "The supply pressure sinks as the accumulator empties, and the load is taken off while there is some.",
        ),
    ),
    Drill(
        Fault.SPECIMEN_BROKEN,
        None,
        Reaction(
            (*JUMP, "lvt", "velocity", "twin_residual", "force_error"),
            0.2,
            "The force is gone at once and the rod leaps; the rig trips on the rate of the force, or on the LVT.",
        ),
    ),
    Drill(
        Fault.AIR_IN_OIL,
        None,
        Reaction(
            (),
            QUIET_S,
            "The load is still followed, with more valve than before: no reason to take it off.",
        ),
    ),
    _both(
        Fault.LATE_TICKS,
        ("deadlines_missed",),
        0.1,
        "Deadlines are missed in one row, and the load is taken off.",
    ),
    _both(
        Fault.CHAIN_OPEN,
        ("hard_wired_chain",),
        AT_ONCE_S,
        "The chain's lamp opens and the pressure falls, whatever the console does.",
    ),
    _both(
        Fault.LVT_FROZEN,
        ("lvt",),
        FROZEN_S,
        "The velocity stands still to the last digit, then the rig trips on its LVT.",
    ),
    _both(
        Fault.LVDT_OPEN,
        ("displacement", "displacement_ahead", "lvdt"),
        AT_ONCE_S,
        "The displacement jumps to the end of its range, and the load is taken off.",
    ),
)
DRILL = {drill.name: drill for drill in DRILLS}
