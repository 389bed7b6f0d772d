"""Colours for pressures and forces, told apart by everybody: the one declaration for scene and legend."""

from collections.abc import Sequence
from typing import NamedTuple


class Colour(NamedTuple):
    """Red, green, blue, each 0…255."""

    red: int
    green: int
    blue: int

    @property
    def hexadecimal(self) -> str:
        """As a page writes it."""
        return f"#{self.red:02x}{self.green:02x}{self.blue:02x}"


UNKNOWN = Colour(128, 128, 128)
# Dark to light, as viridis has it: in order for every eye, and in grey.
PRESSURE = (
    *(Colour(68, 1, 84), Colour(59, 82, 139), Colour(33, 145, 140)),
    *(Colour(94, 201, 98), Colour(253, 231, 37)),
)
# Tension, none, compression.
FORCE = (Colour(33, 102, 172), Colour(150, 155, 160), Colour(214, 96, 20))


def between(colours: Sequence[Colour], share: float | None) -> Colour:
    """The colour at a share 0…1 of a scale, its ends beyond; grey for what is not known."""
    if share is None or share != share:
        return UNKNOWN
    place = min(max(share, 0.0), 1.0) * (len(colours) - 1)
    step = min(int(place), len(colours) - 2)
    parts = zip(colours[step], colours[step + 1], strict=True)
    return Colour(*(round(low + (place - step) * (high - low)) for low, high in parts))


def of_pressure(pressure_pa: float | None, high_pa: float) -> Colour:
    """From none to the supply's high pressure."""
    return between(PRESSURE, None if pressure_pa is None else pressure_pa / high_pa)


def of_force(force_n: float | None, range_n: float) -> Colour:
    """From the range in tension to that in compression."""
    return between(FORCE, None if force_n is None else 0.5 + 0.5 * force_n / range_n)
