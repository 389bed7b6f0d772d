"""The telemetry channels, declared once: every recording, chart and document derives from this table.

Signs (docs/conventions.md): force > 0 is compression of the chain load actuator → unit under test.
"""

from typing import NamedTuple

import numpy as np


class Channel(NamedTuple):
    """One column of the telemetry: its name ends in its unit."""

    name: str
    unit: str
    dtype: str
    doc: str


CHANNELS = (
    Channel("tick", "-", "i8", "Ticks executed since the loop started"),
    Channel("time_s", "s", "f8", "Tick number times the period"),
    Channel("trips", "-", "u8", "Latched detectors, one bit each"),
    Channel("run", "-", "i8", "Number of the run this tick belongs to, 0 for none"),
    Channel(
        "program_tick",
        "-",
        "i8",
        "Tick of the force program: stands still in a hold, jumps on a skip; -1 outside a run",
    ),
    Channel("force_command_n", "N", "f4", "Setpoint of the force loop"),
    Channel("force_n", "N", "f4", "Load cell, compression positive"),
    Channel("force_error_n", "N", "f4", "Setpoint minus load cell"),
    Channel(
        "displacement_m", "m", "f4", "LVDT of the unit under test, away from the actuator positive"
    ),
    Channel("displacement_command_m", "m", "f4", "Position commanded to the unit under test"),
    Channel("velocity_m_s", "m/s", "f4", "LVT: rod relative to the body of the load actuator"),
    Channel("valve_command", "-", "f4", "Servovalve command, -1 to +1, positive raises the force"),
    Channel("spool_position", "-", "f4", "Servovalve spool, share of its half stroke"),
    Channel("pressure_1_pa", "Pa", "f4", "Chamber 1, absolute"),
    Channel("pressure_2_pa", "Pa", "f4", "Chamber 2, absolute"),
    Channel("supply_pressure_pa", "Pa", "f4", "Supply at the manifold, absolute"),
    Channel(
        "compensation_velocity", "-", "f4", "Velocity term of the compensation, in valve command"
    ),
    Channel(
        "compensation_acceleration",
        "-",
        "f4",
        "Acceleration term of the compensation, in valve command",
    ),
    Channel("wakeup_latency_s", "s", "f4", "How long after its deadline this tick began"),
    Channel("tick_time_s", "s", "f4", "How long the tick before this one took"),
    Channel("cycle", "-", "i4", "Cycles completed in this block"),
    Channel("deadlines_missed", "-", "i4", "Deadlines missed and skipped since the loop started"),
    Channel("block", "-", "i2", "Block of the test, from 0; -1 outside a run"),
    Channel("mode", "-", "i1", "State of the loop, see rtcore.modes"),
)

TELEMETRY = np.dtype([(c.name, c.dtype) for c in CHANNELS], align=True)
CHANNEL = {c.name: c for c in CHANNELS}
