"""Where the parts of the rig are drawn (m): x along the chain from the frame plate, z up, y = 0 on its axis.

Cross-sections and masses are to scale, of steel; lengths leave room for what is exaggerated.
"""

import math
from dataclasses import dataclass

from app.scene.chain import Chain, Reading, shifts

STEEL_KG_M3 = 7850.0
ROD_SHARE = 40 / 70  # of the bore's diameter
PLATE_M = 0.04
BODY_FROM_M, BODY_TO_M = 0.12, 0.62
CAP_M = 0.03
PISTON_M, PISTON_AT_M = 0.03, 0.37
PISTON_ROOM_M = 0.19  # either way, before it would leave the drawn bore
ROD_END_M, CELL_M = 0.85, 0.05
FIXTURE_M, UNIT_SPRING_M = 0.10, 0.20  # length of the springs k_2 and k_tra
UNIT_ROD_M, UNIT_BODY_M = 0.40, 0.35
UNIT_ROOM_M = 0.22  # from the end of the unit's rod to its body, at mid stroke
SPOOL_TRAVEL_M = 0.05


@dataclass(frozen=True)
class Sizes:
    """Of what the rig's parameters give a size (m)."""

    bore_m: float  # radii
    rod_m: float
    mass_1_m: float  # edges of cubes
    mass_2_m: float

    @staticmethod
    def of(chain: Chain) -> "Sizes":
        """From the piston's area and the masses."""
        bore_m = math.sqrt(chain.area_m2 / (math.pi * (1.0 - ROD_SHARE**2)))
        edges = ((mass / STEEL_KG_M3) ** (1 / 3) for mass in (chain.m_1_kg, chain.m_2_kg))
        return Sizes(bore_m, ROD_SHARE * bore_m, *edges)

    @property
    def unit_from_m(self) -> float:
        """Where the unit's rod ends at mid stroke."""
        cell_to_m = ROD_END_M + CELL_M
        return cell_to_m + self.mass_1_m + FIXTURE_M + self.mass_2_m + UNIT_SPRING_M

    @property
    def unit_body_from_m(self) -> float:
        """Where the unit's body begins."""
        return self.unit_from_m + UNIT_ROOM_M

    @property
    def end_m(self) -> float:
        """Where the frame ends."""
        return self.unit_body_from_m + UNIT_BODY_M + PLATE_M


@dataclass(frozen=True)
class Drawn:
    """Where the parts are (m): `_from` and `_to` are ends of what is stretched."""

    body: float  # shift of the body
    piston: float  # middle
    rod_end: float
    mass_1: float  # faces towards the load actuator
    mass_2: float
    unit: float  # end of the unit's rod


def drawn(chain: Chain, sizes: Sizes, reading: Reading, deformation: float, travel: float) -> Drawn:
    """The rig at a reading, its deformation and the unit's travel drawn so many times as large."""
    moved = shifts(
        chain, reading.force_n or 0.0, travel * (reading.displacement_m or 0.0), deformation
    )
    cell_to_m = ROD_END_M + CELL_M
    slid_m = min(max(moved.rod_m - moved.body_m, -PISTON_ROOM_M), PISTON_ROOM_M)
    return Drawn(
        body=moved.body_m,
        piston=PISTON_AT_M + moved.body_m + slid_m,
        rod_end=ROD_END_M + moved.rod_m,
        mass_1=cell_to_m + moved.mass_1_m,
        mass_2=cell_to_m + sizes.mass_1_m + FIXTURE_M + moved.mass_2_m,
        unit=sizes.unit_from_m + moved.unit_m,
    )
