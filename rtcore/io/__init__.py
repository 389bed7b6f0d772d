"""The boundary to the world: what the loop reads and writes, whichever rig is behind it."""

from typing import Protocol

import numpy as np

# What a rig's converters deliver each tick, in SI but neither tared nor checked.
INPUTS = np.dtype(
    [
        ("force_n", "f8"),
        ("displacement_m", "f8"),
        ("velocity_m_s", "f8"),
        ("spool_position", "f8"),
        ("pressure_1_pa", "f8"),
        ("pressure_2_pa", "f8"),
        ("supply_pressure_pa", "f8"),
        ("chain", "i8"),  # the hard-wired chain: 1 closed, 0 open
    ],
    align=True,
)

# What the loop asks of the rig each tick.
OUTPUTS = np.dtype(
    [
        ("valve_command", "f8"),  # -1…+1
        ("displacement_command_m", "f8"),
        ("supply", "i8"),  # 0 off and bled, 1 low, 2 high
    ],
    align=True,
)

FAULT_SLOTS = 32  # kinds of faults that a simulated rig may be told to have

SUPPLY_OFF, SUPPLY_LOW, SUPPLY_HIGH = 0, 1, 2


class Io(Protocol):
    """A rig, simulated or real, bound to the tick. One compiled call does read → tick → write."""

    def warm_up(self) -> None:
        """Compile and freeze everything that a tick may call."""

    def cycle(self, now_ns: int, wakeup_latency_ns: int, tick_time_ns: int, missed: int) -> None:
        """One tick. Times in ns, `missed` deadlines just before it."""

    def close(self) -> None:
        """Leave the rig safe: valve at null, supply off."""
