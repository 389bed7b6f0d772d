"""The transfers that a run can show: from which channel to which, declared once."""

from typing import NamedTuple


class Transfer(NamedTuple):
    """Output over input, both channels; `unit` is that of the gain."""

    name: str
    input: str
    output: str
    unit: str
    doc: str


_TABLE = (
    Transfer("force", "force_command_n", "force_n", "1", "Force to its setpoint: the closed loop"),
    Transfer("plant", "valve_command", "force_n", "N", "Force to valve command: the plant"),
    Transfer(
        "motion", "valve_command", "velocity_m_s", "m/s", "Rod velocity to valve command: the plant"
    ),
    Transfer(
        "disturbance",
        "velocity_m_s",
        "force_n",
        "N s/m",
        "Force to rod velocity: what a motion does to the force",
    ),
    Transfer("compliance", "force_n", "displacement_m", "m/N", "Displacement of the unit to force"),
)
_OF_MOTION = (
    Transfer(
        "position",
        "displacement_command_m",
        "displacement_m",
        "1",
        "Displacement of the unit to its command: its position response",
    ),
)
_OF_UNIT = (
    Transfer(
        "stiffness",
        "unit_deformation_m",
        "unit_force_n",
        "N/m",
        "Dynamic stiffness of the unit: force on it to its deformation",
    ),
    Transfer(
        "admittance",
        "unit_force_n",
        "unit_deformation_m_s",
        "m/(N s)",
        "Admittance of the unit: velocity of its deformation to the force on it",
    ),
)
_OF_LOOP = (
    Transfer(
        "loop",
        "force_command_n",
        "force_n",
        "1",
        "Open loop: the measured plant under the run's own controller",
    ),
)
# Along the force's program, of which each sine is known.
TRANSFERS = {transfer.name: transfer for transfer in _TABLE}
# Along the program of the motion.
MOTION_TRANSFERS = {transfer.name: transfer for transfer in _OF_MOTION}
# What no channel has but a model of the rig makes of them (`app.analysis.response.unit_under_test`).
UNIT_TRANSFERS = {transfer.name: transfer for transfer in _OF_UNIT}
# What the plant's transfers and the run's controller make (`app.runs.response_loop`).
LOOP_TRANSFERS = {transfer.name: transfer for transfer in _OF_LOOP}
EVERY = TRANSFERS | MOTION_TRANSFERS | UNIT_TRANSFERS | LOOP_TRANSFERS
