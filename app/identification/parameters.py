"""The parameters that can be fitted, declared once: where each is in a rig, its name, and how far it may go."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import numpy.typing as npt

from rtcore.rig.parameters import RigParameters

Floats = npt.NDArray[np.float64]


class Group(StrEnum):
    """What a parameter is part of."""

    STRUCTURE = "structure"
    BYPASS = "bypass"
    VALVE = "valve"
    FRICTION = "friction"
    OIL = "oil"
    SUPPLY = "supply"
    UNIT = "unit"


@dataclass(frozen=True)
class Parameter:
    """One value of a rig.

    It is searched for as its logarithm where `scale` is None, else in units of `scale` about nothing.
    `least` and `most` bound it: as factors on the value to begin with, or as they are where there is a scale.
    """

    path: str
    title: str
    unit: str
    group: Group
    least: float = 1.0 / 3.0
    most: float = 3.0
    scale: float | None = None

    def coordinate(self, value: float) -> float:
        """What the search moves."""
        return float(np.log(value)) if self.scale is None else value / self.scale

    def value(self, coordinate: float) -> float:
        """The opposite."""
        return float(np.exp(coordinate)) if self.scale is None else coordinate * self.scale

    def slope(self, coordinate: float) -> float:
        """d(value)/d(coordinate): from an interval of the one to that of the other."""
        return self.value(coordinate) if self.scale is None else self.scale

    def bounds(self, begun_with: float) -> tuple[float, float]:
        """Least and greatest coordinate, from the value that the search begins with."""
        if self.scale is not None:
            return self.least / self.scale, self.most / self.scale
        here = self.coordinate(begun_with)
        return here + float(np.log(self.least)), here + float(np.log(self.most))


_S, _B, _V, _F, _O, _P, _U = Group
PARAMETERS = (
    Parameter("structure.k_pl", "frame plate, stiffness", "N/m", _S),
    Parameter("structure.c_pl", "frame plate, damping", "N s/m", _S),
    Parameter("structure.k_lc", "load cell and joints, stiffness", "N/m", _S, 0.5, 2.0),
    Parameter("structure.c_lc", "load cell and joints, damping", "N s/m", _S),
    Parameter("structure.k_2", "fixture between the masses, stiffness", "N/m", _S),
    Parameter("structure.c_2", "fixture between the masses, damping", "N s/m", _S),
    Parameter("unit.k_tra", "unit under test, stiffness", "N/m", _S),
    Parameter("unit.c_tra", "unit under test, damping", "N s/m", _S),
    Parameter("load_actuator.bypass_diameter_m", "bypass orifice, diameter", "m", _B, 0.5, 2.0),
    Parameter("load_actuator.bypass_transition_reynolds", "bypass, laminar share", "-", _B),
    Parameter("load_actuator.leak_m3_s_pa", "leakage across the piston", "m³/(s Pa)", _B, 0.1, 10.0),
    Parameter("servovalve.omega_f_rad_s", "first stage, natural frequency", "rad/s", _V),
    Parameter("servovalve.zeta_f", "first stage, damping", "-", _V, 0.5, 2.0),
    Parameter("servovalve.spool_gain_rad_s", "spool loop, K_sp", "rad/s", _V),
    Parameter("servovalve.discharge", "lands, C_d", "-", _V, 0.6, 1.5),
    Parameter("servovalve.null_m", "null of the spool", "m", _V, -4e-5, 4e-5, 1e-5),
    Parameter("load_actuator.coulomb_n", "Coulomb friction", "N", _F, 0.1, 10.0),
    Parameter("load_actuator.coulomb_m_s", "velocity over which friction turns", "m/s", _F, 0.1, 10.0),
    Parameter("load_actuator.viscous_n_s_m", "viscous friction", "N s/m", _F, 0.1, 10.0),
    Parameter("fluid.bulk_modulus_pa", "bulk modulus of the oil", "Pa", _O, 0.5, 1.9),
    Parameter("fluid.free_air", "free air in the oil", "-", _O, 0.05, 10.0),
    Parameter("supply.high_pa", "pressure of the pump", "Pa", _P, 0.8, 1.2),
    Parameter("supply.line_supply_k", "supply line, loss", "Pa/(m³/s)²", _P, 0.1, 10.0),
    Parameter("unit.omega_t_rad_s", "position servo, natural frequency", "rad/s", _U),
    Parameter("unit.zeta_t", "position servo, damping", "-", _U),
)  # fmt: skip
PARAMETER = {p.path: p for p in PARAMETERS}


def read(rig: RigParameters, path: str) -> float:
    """The value of a rig at `part.name`."""
    part, name = path.split(".")
    return float(getattr(getattr(rig, part), name))


def coordinates(rig: RigParameters, wanted: Sequence[Parameter]) -> Floats:
    """(n,) where a rig is, as the search sees it."""
    return np.array([p.coordinate(read(rig, p.path)) for p in wanted])


def changed(rig: RigParameters, values: Mapping[str, float]) -> RigParameters:
    """A rig with some values changed. Raises pydantic's ValidationError where they do not go together."""
    data = rig.model_dump()
    for path, value in values.items():
        part, name = path.split(".")
        data[part][name] = value
    return RigParameters.model_validate(data)


def placed(rig: RigParameters, wanted: Sequence[Parameter], at: Floats) -> RigParameters:
    """A rig at (n,) coordinates."""
    return changed(rig, {p.path: p.value(float(x)) for p, x in zip(wanted, at, strict=True)})
