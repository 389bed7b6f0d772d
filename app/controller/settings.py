"""Gains and compensator of the control law, in the paper's names (section 6, figures 10 and 11)."""

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from app.controller.presets import COMPENSATORS, DEFAULT_COMPENSATOR
from app.documents.fields import Document, wrong
from app.documents.messages import nearest

CORNER_LIMIT_HZ = 2000.0  # half the loop rate

Gain = Annotated[float, Field(ge=0, le=1.0)]
CornerHz = Annotated[float, Field(gt=0, lt=CORNER_LIMIT_HZ)]


class Compensator(Document):
    """The kinematic compensation: lead, low-pass and notch on the LVT, then two gains.

    Lead: (1 + s/ω_z)/(1 + s/ω_p) · f_z/f_p, which is 1 at high frequency. Notch: centred on the
    load frequency. The branch gives FF_V times the filtered velocity plus FF_A times its
    derivative.
    """

    ff_v: float = Field(ge=-100, le=100, description="FF_V, s/m: valve command per m/s")
    ff_a: float = Field(ge=-10, le=10, description="FF_A, s²/m: valve command per m/s²")
    lead_zero_hz: CornerHz = Field(description="f_z of the lead")
    lead_pole_hz: CornerHz = Field(description="f_p of the lead")
    low_pass_hz: CornerHz = Field(description="corner of the low-pass")
    low_pass_order: Literal[1, 2] = 1
    low_pass_damping: float | None = Field(default=None, gt=0, lt=10, description="order 2 only")
    notch_damping: float = Field(gt=0, lt=10, description="ζ_d of the notch: half its width")
    fade_s: float = Field(default=0.1, ge=1e-4, le=10, description="to join or leave")

    @model_validator(mode="after")
    def _damped(self) -> Self:
        if (self.low_pass_damping is None) == (self.low_pass_order == 2):
            need = "needs" if self.low_pass_order == 2 else "has no"
            message = f"a low-pass of order {self.low_pass_order} {need} low_pass_damping"
            raise wrong("low_pass_damping", message, value=self.low_pass_damping)
        return self


def _by_name(value: Any) -> Any:
    """A compensator may be named after a preset: `COMP8`."""
    if not isinstance(value, str):
        return value
    if value not in COMPENSATORS:
        guess = nearest(value, COMPENSATORS) or f"; known: {', '.join(COMPENSATORS)}"
        raise wrong("", f"unknown compensator '{value}'{guess}", value=value)
    return COMPENSATORS[value]


class ControllerSettings(Document):
    """Everything that the control law can be set to; what a file leaves out is as shipped.

    V = K_P e + I + K_D d + K_FF ΔF_set/T + compensation, with I from K_I and clamping anti-windup.
    """

    k_p: Gain = Field(default=1.19e-5, description="K_P, 1/N: valve command per newton")
    k_i: Gain = Field(default=4.38e-3, description="K_I, 1/(N s)")
    k_d: Gain = Field(default=3.39e-8, description="K_D, s/N, on the filtered error")
    derivative_hz: CornerHz = Field(default=190.0, description="corner of the derivative's filter")
    k_ff: Gain = Field(default=6e-9, description="K_FF, s/N, on the change of the setpoint")
    valve_limit: float = Field(default=1.0, gt=0, le=1, description="saturation, valve command")
    valve_slew_per_s: float | None = Field(default=None, gt=0, description="None: no limit")
    compensator: Annotated[Compensator, BeforeValidator(_by_name)] = Field(
        default=DEFAULT_COMPENSATOR, validate_default=True
    )
