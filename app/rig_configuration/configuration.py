"""The document: bounded, unknown keys refused; what it leaves out is as shipped."""

from collections.abc import Mapping
from datetime import date
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, Field, StringConstraints, model_validator

from app.db import NO_NUL
from app.definitions.limits import RIG
from app.documents.fields import Document, wrong
from rtcore.rig.parameters import RigParameters, load_rig

Words = Annotated[str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, max_length=200)]
Notes = Annotated[str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, max_length=2000)]
FULL_SCALE_V = 10.0


class TypePlate(Document):
    """Something with a type plate."""

    name: Words = ""
    maker: Words = ""
    part_number: Words = ""
    serial_number: Words = ""
    notes: Notes = ""


class Calibration(Document):
    """A sensor and its certificate. Gain and offset are those of the converter behind the I/O boundary."""

    maker: Words = ""
    part_number: Words = ""
    serial_number: Words = ""
    gain: float = Field(gt=-1e9, lt=1e9, description="SI unit per volt, never 0")
    offset: float = Field(default=0.0, gt=-1e9, lt=1e9, description="SI unit, at 0 V")
    class_percent: float | None = Field(
        default=None, gt=0, le=100, description="accuracy class, of full scale"
    )
    calibrated_on: date | None = None
    due_on: date | None = None
    certificate: Words = ""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.gain == 0.0:
            raise wrong("gain", "must not be 0: nothing could be read", value=self.gain)
        if self.due_on is None:
            return self
        if self.calibrated_on is None:
            raise wrong("due_on", "needs calibrated_on beside it", value=str(self.due_on))
        if self.due_on <= self.calibrated_on:
            raise wrong(
                "due_on",
                f"must be after calibrated_on, {self.calibrated_on}",
                value=str(self.due_on),
            )
        return self


def _of_range(range_si: float) -> Calibration:
    return Calibration(gain=range_si / FULL_SCALE_V)


class Calibrations(Document):
    """Of every sensor of the rig."""

    load_cell: Calibration = _of_range(60e3)
    lvt: Calibration = _of_range(0.5)
    lvdt: Calibration = _of_range(0.035)
    pressure_1: Calibration = _of_range(35e6)
    pressure_2: Calibration = _of_range(35e6)
    supply_pressure: Calibration = _of_range(35e6)


class LabLimits(Document):
    """What the lab lets tests ask of this rig and unit, within what the rig can do; None for no limit of its own."""

    force_n: float | None = Field(default=None, gt=0, le=RIG.force_limit_n)
    displacement_m: float | None = Field(default=None, gt=0, le=RIG.stroke_limit_m)


def _with_shipped(model: Any) -> Any:
    """A model may name only what differs from the one that ships with forcerig."""
    if isinstance(model, Mapping):
        return _merged(load_rig().model_dump(), model)
    return model


def _merged(base: dict[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        inner = merged.get(key)
        if isinstance(inner, dict) and isinstance(value, Mapping):
            value = _merged(inner, value)
        merged[key] = value
    return merged


class RigConfiguration(Document):
    """What predictions, the live twin, linear analysis and reports know of the rig.

    The model describes the rig behind the I/O boundary, which knows nothing of it: a simulated one stays as it
    was started.
    """

    lab: Words = Field(default="", description="name of the lab that runs the rig")
    rig: TypePlate = TypePlate(name="Tail rotor actuator rig")
    unit_under_test: TypePlate = TypePlate(name="Tail rotor actuator")
    calibrations: Calibrations = Calibrations()
    limits: LabLimits = LabLimits()
    model: Annotated[RigParameters, BeforeValidator(_with_shipped)] = Field(
        default_factory=load_rig
    )
