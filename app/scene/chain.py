"""Where the parts of the chain are under a force: the rig's model at rest, from what is measured.

Frame –k_pl– body – (oil) – rod –k_lc– mass 1 –k_2– mass 2 –k_tra– the unit's own output.
"""

from dataclasses import dataclass
from typing import NamedTuple

from rtcore.rig.parameters import RigParameters


@dataclass(frozen=True)
class Chain:
    """What of a rig is drawn: stiffnesses (N/m), masses (kg), sizes and ranges. SI, as in the rig's sheet."""

    k_pl: float
    k_lc: float
    k_2: float
    k_tra: float
    m_1_kg: float
    m_2_kg: float
    area_m2: float
    stroke_m: float  # half stroke of the unit
    force_n: float  # range of the load cell, either way
    pressure_pa: float  # of the supply at high

    @staticmethod
    def of(rig: RigParameters) -> "Chain":
        """The chain of a rig."""
        structure, unit = rig.structure, rig.unit
        return Chain(
            *(structure.k_pl, structure.k_lc, structure.k_2, unit.k_tra),
            *(structure.m_1_kg, structure.m_2_kg, rig.load_actuator.area_m2, unit.stroke_m),
            *(rig.sensors.force_range_n, rig.supply.high_pa),
        )


class Reading(NamedTuple):
    """What is known of the rig at one moment, by the names of the channels; None where it is not."""

    force_n: float | None = None
    displacement_m: float | None = None
    pressure_1_pa: float | None = None
    pressure_2_pa: float | None = None
    supply_pressure_pa: float | None = None
    spool_position: float | None = None


class Shifts(NamedTuple):
    """How far each part has moved (m) from where it is without force, the unit at its middle."""

    body_m: float
    rod_m: float
    mass_1_m: float
    mass_2_m: float
    unit_m: float


def shifts(chain: Chain, force_n: float, displacement_m: float, deformation: float = 1.0) -> Shifts:
    """The chain in equilibrium with its force: no inertia, which below 100 Hz is under a tenth.

    `deformation` draws what the springs give so many times as large; the unit's own motion stays.
    """
    given_m = deformation * force_n
    mass_2_m = displacement_m + given_m / chain.k_tra
    mass_1_m = mass_2_m + given_m / chain.k_2
    rod_m = mass_1_m + given_m / chain.k_lc
    return Shifts(-given_m / chain.k_pl, rod_m, mass_1_m, mass_2_m, displacement_m)
