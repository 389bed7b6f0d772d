"""The rig's parameters: validated, bounded, SI; read from YAML or JSON and turned into plant constants.

A file need name only what differs from the rig that ships with forcerig (`rig.yaml`).
"""

from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Self

import yaml
from pydantic import BaseModel, ConfigDict, Field, model_validator

from rtcore.rig.rates import FASTEST_1_S, fastest_part, smallest_chambers

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
LEAST_REYNOLDS = 1e-3  # with none at all, a restriction has no flow that belongs to no drop


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Supply(_Part):
    """Pump, lines and accumulators; pressures are absolute."""

    high_pa: float = Field(ge=5e6, le=35e6, description="pump pressure at high")
    low_pa: float = Field(ge=1e6, le=20e6, description="pump pressure at low")
    ramp_pa_s: float = Field(
        ge=1e5, le=1e9, description="how fast the pump's pressure control moves"
    )
    tank_pa: float = Field(ge=1e5, le=2e6, description="tank and return line")
    relief_pa: float = Field(ge=6e6, le=45e6, description="cracking pressure of the relief valve")
    relief_m3_s_pa: NotNegative = Field(
        le=1e-6, description="relief valve, flow over cracking pressure"
    )
    bleed_m3_s: float = Field(gt=0, le=1e-2, description="bleed valve, flow at high pressure")
    line_supply_k: float = Field(gt=0, le=1e14, description="quadratic loss, Pa/(m³/s)²")
    line_return_k: float = Field(gt=0, le=1e14, description="quadratic loss, Pa/(m³/s)²")
    line_supply_r: float = Field(ge=1e5, le=1e10, description="laminar loss, Pa/(m³/s)")
    line_return_r: float = Field(ge=1e5, le=1e10, description="laminar loss, Pa/(m³/s)")
    hose_m3_pa: float = Field(
        ge=3e-12, le=1e-9, description="elasticity of the hoses, below precharge"
    )
    accumulator_supply_m3: float = Field(ge=1e-4, le=0.1)
    precharge_supply_pa: float = Field(ge=5e5, le=3e7)
    accumulator_return_m3: float = Field(ge=1e-4, le=0.1)
    precharge_return_pa: float = Field(ge=1e5, le=2e6)
    accumulator_n: float = Field(ge=1.0, le=1.7, description="polytropic exponent of the gas")


class Fluid(_Part):
    """Oil at 40 °C and how it changes with temperature; free air at the reference pressure."""

    temperature_c: float = Field(ge=-20, le=110)
    reference_pa: float = Field(ge=5e4, le=2e5)
    density_kg_m3: float = Field(ge=600, le=1200)
    bulk_modulus_pa: float = Field(ge=5e8, le=3e9)
    bulk_modulus_slope: float = Field(ge=1, le=30, description="d(β)/dp of the liquid")
    viscosity_m2_s: float = Field(ge=1e-6, le=1e-3)
    free_air: float = Field(ge=1e-5, le=0.2, description="undissolved air, share of volume")
    air_n: float = Field(ge=1.0, le=1.67, description="polytropic exponent of the air")


class Servovalve(_Part):
    """First stage, spool and four lands; underlap > 0 is open at null."""

    omega_f_rad_s: float = Field(ge=100, le=1e4)
    zeta_f: float = Field(ge=0.1, le=2)
    flapper_stop_k: float = Field(ge=1, le=100)
    flapper_stop_c: float = Field(ge=0, le=20)
    spool_gain_rad_s: float = Field(ge=10, le=5e3, description="K_sp of the external electronics")
    spool_rate_m_s: float = Field(ge=0.01, le=5, description="at the flapper's end of travel")
    spool_stroke_m: float = Field(ge=1e-4, le=5e-3, description="half stroke")
    spool_stop_1_s: float = Field(ge=1e3, le=2.5e4)
    null_m: float = Field(ge=-2e-4, le=2e-4, description="null offset of the spool")
    window_m: float = Field(ge=1e-3, le=0.2, description="metering width of a land")
    discharge: float = Field(ge=0.3, le=1, description="turbulent C_d of a land")
    transition_reynolds: float = Field(ge=LEAST_REYNOLDS, le=1e3)
    clearance_m: float = Field(ge=1e-7, le=5e-5, description="radial, spool to sleeve")
    underlap_pa_m: float = Field(ge=-1e-4, le=1e-4)
    underlap_at_m: float = Field(ge=-1e-4, le=1e-4)
    underlap_pb_m: float = Field(ge=-1e-4, le=1e-4)
    underlap_bt_m: float = Field(ge=-1e-4, le=1e-4)


class LoadActuator(_Part):
    """Balanced cylinder on hydrostatic bearings, with its bypass orifice."""

    area_m2: float = Field(ge=1e-5, le=0.1)
    volume_1_m3: float = Field(ge=1e-6, le=0.1, description="chamber 1 at mid stroke")
    volume_2_m3: float = Field(ge=1e-6, le=0.1, description="chamber 2 at mid stroke")
    bypass_diameter_m: float = Field(ge=1e-4, le=1e-2)
    bypass_discharge: float = Field(ge=0.3, le=1)
    bypass_transition_reynolds: float = Field(ge=LEAST_REYNOLDS, le=1e4)
    bypass_linear_m3_s_pa: NotNegative = Field(
        le=1e-9, description="a linear bypass beside the orifice"
    )
    leak_m3_s_pa: NotNegative = Field(le=1e-9, description="across the piston")
    drain_1_m3_s_pa: NotNegative = Field(le=1e-9)
    drain_2_m3_s_pa: NotNegative = Field(le=1e-9)
    drain_pa: float = Field(ge=5e4, le=1e6)
    coulomb_n: NotNegative = Field(le=1e4)
    coulomb_m_s: float = Field(
        ge=1e-5, le=0.1, description="velocity over which friction turns round"
    )
    viscous_n_s_m: NotNegative = Field(le=1e5)
    end_cap_share: float = Field(
        ge=0.01,
        le=0.9,
        description="left of the smaller chamber where the piston meets its end cap",
    )
    end_stop_n_m: float = Field(ge=1e6, le=2e9, description="stiffness of piston on end cap")
    end_stop_s_m: NotNegative = Field(le=10, description="more force at a speed, share a m/s")


class Structure(_Part):
    """Masses (kg), stiffnesses (N/m) and dampings (N s/m) of the chain, in the paper's names."""

    m_b_kg: float = Field(ge=1, le=1e4)
    m_la_kg: float = Field(ge=0.5, le=1e3)
    m_1_kg: float = Field(ge=0.5, le=1e3)
    m_2_kg: float = Field(ge=0.5, le=1e3)
    k_pl: float = Field(ge=1e5, le=1e10)
    c_pl: NotNegative = Field(le=1e6)
    k_lc: float = Field(ge=1e6, le=2e9)
    c_lc: NotNegative = Field(le=1e6)
    k_2: float = Field(ge=1e5, le=1e10)
    c_2: NotNegative = Field(le=1e6)


class UnitUnderTest(_Part):
    """The tail rotor actuator: stiffness, and the servo that moves its output."""

    k_tra: float = Field(ge=1e5, le=1e10)
    c_tra: NotNegative = Field(le=1e6)
    omega_t_rad_s: float = Field(ge=1, le=1e3)
    zeta_t: float = Field(ge=0.1, le=3)
    rate_m_s: float = Field(gt=0, le=5)
    stroke_m: float = Field(gt=0, le=1, description="half stroke")


class Sensors(_Part):
    """Chains, noise at the converter (1 sigma) and full scale of the 16-bit converters."""

    omega_lc_rad_s: float = Field(ge=1e2, le=2e4)
    zeta_lc: float = Field(ge=0.2, le=2)
    omega_lvt_rad_s: float = Field(ge=1e2, le=2e4)
    force_noise_n: NotNegative = Field(le=1e4)
    velocity_noise_m_s: NotNegative = Field(le=0.1)
    force_range_n: float = Field(ge=1e2, le=1e6)
    velocity_range_m_s: float = Field(ge=1e-2, le=10)
    displacement_range_m: float = Field(ge=1e-3, le=1)
    pressure_range_pa: float = Field(ge=1e6, le=1e8)
    bits: int = Field(ge=8, le=32)


class RigParameters(_Part):
    """Everything that the simulated rig is made of."""

    name: str = Field(min_length=1, max_length=80)
    supply: Supply
    fluid: Fluid
    servovalve: Servovalve
    load_actuator: LoadActuator
    structure: Structure
    unit: UnitUnderTest
    sensors: Sensors

    @model_validator(mode="after")
    def _can_be_followed(self) -> Self:
        """Values that are sound one by one may still not go together."""
        part, rate = fastest_part(self)
        if not rate <= FASTEST_1_S:
            raise ValueError(
                f"the {part} of this rig moves at {rate:,.0f} 1/s, and the simulation follows"
                f" {FASTEST_1_S:,.0f} 1/s: less stiffness or damping, or more mass"
            )
        for chamber, left in enumerate(smallest_chambers(self), start=1):
            if not left > 0.0:
                raise ValueError(
                    f"load_actuator.volume_{chamber}_m3 is less than unit.stroke_m and area_m2 take of it"
                )
        return self


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        inner = merged.get(key)
        merged[key] = (
            _merged(inner, value)
            if isinstance(inner, dict) and isinstance(value, Mapping)
            else value
        )
    return merged


def rig_from(overrides: Mapping[str, Any]) -> RigParameters:
    """The shipped rig with some values changed. Raises pydantic's ValidationError, path by path."""
    shipped = yaml.safe_load(files("rtcore.rig").joinpath("rig.yaml").read_text(encoding="utf-8"))
    return RigParameters.model_validate(_merged(shipped, overrides))


def load_rig(path: Path | None = None) -> RigParameters:
    """The rig of a YAML or JSON file, or the shipped one.

    Raises OSError, yaml.YAMLError, ValueError (not a mapping) or pydantic's ValidationError.
    """
    if path is None:
        return rig_from({})
    overrides = yaml.safe_load(path.read_text(encoding="utf-8"))
    if not isinstance(overrides, Mapping):
        raise ValueError(
            f"{path.name}: a rig is a mapping of parts, such as 'supply: {{high_pa: 21.0e6}}'"
        )
    return rig_from(overrides)
