"""The rig in the scene of one browser: made once, then moved, stretched and coloured."""

from viser import SceneApi

from app.scene import words
from app.scene.chain import Chain, Reading
from app.scene.colours import Colour, of_force, of_pressure
from app.scene.layout import (
    BODY_FROM_M,
    BODY_TO_M,
    CAP_M,
    CELL_M,
    PISTON_M,
    PLATE_M,
    SPOOL_TRAVEL_M,
    UNIT_BODY_M,
    UNIT_ROD_M,
    Drawn,
    Sizes,
    drawn,
)
from app.scene.parts import Parts, put, span

STEEL, FRAME, BLOCK = Colour(165, 172, 180), Colour(105, 112, 122), Colour(196, 200, 205)
COIL, UNIT, GLASS, SPOOL = (
    *(Colour(130, 136, 144), Colour(176, 160, 130)),
    *(Colour(190, 205, 220), Colour(230, 120, 40)),
)
UNDER_M, OVER_M = -0.16, 0.13  # of the frame's top and of the labels, from the chain's axis
PLATE_WIDE_M, WALL_M = 0.36, 0.012
MANIFOLD_M = (0.24, 0.07, 0.05)


class Model:
    """The parts of a rig in a scene."""

    def __init__(self, scene: SceneApi, chain: Chain) -> None:
        self.chain = chain
        self._sizes = sizes = Sizes.of(chain)
        self._parts = parts = Parts(scene)
        self._frame()
        over_m = sizes.bore_m + WALL_M + 0.5 * MANIFOLD_M[2]
        self._over_m = over_m
        self._caps = [parts.bar(f"rig/cap_{n}", sizes.bore_m + WALL_M, FRAME) for n in (1, 2)]
        self._spool = parts.bar("rig/spool", 0.012, SPOOL)
        self._piston = parts.bar("rig/piston", sizes.bore_m + 0.5 * WALL_M, STEEL)
        self._rod = parts.bar("rig/rod", sizes.rod_m, STEEL)
        self._cell = parts.bar("rig/load_cell", 0.042, STEEL)
        self._mass_1 = parts.block("rig/mass_1", (sizes.mass_1_m,) * 3, BLOCK)
        self._mass_2 = parts.block("rig/mass_2", (sizes.mass_2_m,) * 3, BLOCK)
        self._unit_rod = parts.bar("rig/unit_rod", 0.02, STEEL)
        self._k_pl, self._k_2, self._k_tra = (
            parts.spring(f"rig/{name}", radius_m, COIL)
            for name, radius_m in (("k_pl", 0.06), ("k_2", 0.035), ("k_tra", 0.035))
        )
        self._chambers = [parts.bar(f"rig/chamber_{n}", sizes.bore_m, STEEL) for n in (1, 2)]
        # What is seen through comes last: it hides nothing that was drawn before.
        self._manifold = parts.block("rig/manifold", MANIFOLD_M, GLASS, 0.45)
        self._labels = {name: parts.label(f"label/{name}") for name in _LABELS}

    def show(self, reading: Reading, deformation: float, travel: float) -> None:
        """Draw a reading; deformation and the unit's travel so many times as large as they are."""
        at = drawn(self.chain, self._sizes, reading, deformation, travel)
        self._show_actuator(at, reading)
        self._show_chain(at, reading)

    def say(self, reading: Reading, deformation: float, travel: float) -> None:
        """Bring the labels up to a reading."""
        at = drawn(self.chain, self._sizes, reading, deformation, travel)
        for name, (text, x_m, z_m) in self._said(at, reading).items():
            self._labels[name].text = text
            put(self._labels[name], x_m, 0.0, z_m)

    def _frame(self) -> None:
        """What does not move: the plate, the unit's body and its wall, and the bed below."""
        parts, sizes = self._parts, self._sizes
        wall = (PLATE_M, PLATE_WIDE_M, PLATE_WIDE_M)
        put(parts.block("frame/plate", wall, FRAME), -0.5 * PLATE_M)
        put(parts.block("frame/wall", wall, FRAME), sizes.end_m - 0.5 * PLATE_M)
        long_m = sizes.end_m + PLATE_M
        bed = parts.block("frame/bed", (long_m, PLATE_WIDE_M, PLATE_M), FRAME)
        put(bed, 0.5 * (sizes.end_m - PLATE_M), 0.0, UNDER_M - 0.5 * PLATE_M)
        body = parts.block("frame/unit", (UNIT_BODY_M, 0.15, 0.15), UNIT, 0.9)
        put(body, sizes.unit_body_from_m + 0.5 * UNIT_BODY_M)

    def _show_actuator(self, at: Drawn, reading: Reading) -> None:
        from_m, to_m = BODY_FROM_M + at.body, BODY_TO_M + at.body
        middle_m, half_m = 0.5 * (from_m + to_m), 0.5 * PISTON_M
        span(self._k_pl, 0.0, from_m)
        span(self._caps[0], from_m, from_m + CAP_M)
        span(self._caps[1], to_m - CAP_M, to_m)
        span(self._piston, at.piston - half_m, at.piston + half_m)
        span(self._rod, at.piston + half_m, at.rod_end)
        span(self._chambers[0], from_m + CAP_M, at.piston - half_m)
        span(self._chambers[1], at.piston + half_m, to_m - CAP_M)
        pressures = (reading.pressure_1_pa, reading.pressure_2_pa)
        for chamber, pressure_pa in zip(self._chambers, pressures, strict=True):
            chamber.color = of_pressure(pressure_pa, self.chain.pressure_pa)
        put(self._manifold, middle_m, 0.0, self._over_m)
        self._manifold.color = of_pressure(reading.supply_pressure_pa, self.chain.pressure_pa)
        spool_m = middle_m + SPOOL_TRAVEL_M * (reading.spool_position or 0.0)
        span(self._spool, spool_m - 0.04, spool_m + 0.04)
        put(self._spool, spool_m, 0.0, self._over_m)

    def _show_chain(self, at: Drawn, reading: Reading) -> None:
        sizes = self._sizes
        span(self._cell, at.rod_end, at.mass_1)
        self._cell.color = of_force(reading.force_n, self.chain.force_n)
        put(self._mass_1, at.mass_1 + 0.5 * sizes.mass_1_m)
        span(self._k_2, at.mass_1 + sizes.mass_1_m, at.mass_2)
        put(self._mass_2, at.mass_2 + 0.5 * sizes.mass_2_m)
        span(self._k_tra, at.mass_2 + sizes.mass_2_m, at.unit)
        span(self._unit_rod, at.unit, at.unit + UNIT_ROD_M)

    def _said(self, at: Drawn, reading: Reading) -> dict[str, tuple[str, float, float]]:
        """Each label's text and where it is: over what it is of."""
        middle_m = 0.5 * (BODY_FROM_M + BODY_TO_M) + at.body
        quarter_m = 0.25 * (BODY_TO_M - BODY_FROM_M)
        below_m = -self._sizes.bore_m - 0.05
        return {
            "supply": (
                f"supply {words.pressure(reading.supply_pressure_pa)}, spool {words.share(reading.spool_position)}",
                middle_m,
                self._over_m + 0.06,
            ),
            "chamber_1": (words.pressure(reading.pressure_1_pa), middle_m - quarter_m, below_m),
            "chamber_2": (words.pressure(reading.pressure_2_pa), middle_m + quarter_m, below_m),
            "force": (words.force(reading.force_n), at.rod_end + 0.5 * CELL_M, OVER_M),
            "unit": (words.length(reading.displacement_m), at.unit, OVER_M),
        }


_LABELS = ("supply", "chamber_1", "chamber_2", "force", "unit")
