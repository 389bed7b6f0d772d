"""Controller settings for the loop, and from files."""

import math
from pathlib import Path
from typing import Any

import numpy as np

from app.controller.settings import ControllerSettings
from app.documents.reading import read_data, read_file
from app.errors import Code, Refusal
from rtcore.control.gains import GAINS

UNUSED_DAMPING = 0.7  # of a first-order low-pass, which has none


def to_record(settings: ControllerSettings) -> Any:
    """The settings as a GAINS record, () of dtype GAINS."""
    c = settings.compensator
    slew = settings.valve_slew_per_s
    values = {
        "k_p": settings.k_p,
        "k_i": settings.k_i,
        "k_d": settings.k_d,
        "omega_d_rad_s": 2 * math.pi * settings.derivative_hz,
        "k_ff": settings.k_ff,
        "valve_limit": settings.valve_limit,
        "valve_slew_per_s": math.inf if slew is None else slew,
        "ff_v": c.ff_v,
        "ff_a": c.ff_a,
        "lead_zero_rad_s": 2 * math.pi * c.lead_zero_hz,
        "lead_pole_rad_s": 2 * math.pi * c.lead_pole_hz,
        "low_pass_rad_s": 2 * math.pi * c.low_pass_hz,
        "low_pass_damping": UNUSED_DAMPING if c.low_pass_damping is None else c.low_pass_damping,
        "notch_damping": c.notch_damping,
        "fade_s": c.fade_s,
        "low_pass_order": c.low_pass_order,
        "compensate": 1,
    }
    return np.array(tuple(values[name] for name in GAINS.names or ()), GAINS)


def load_controller(path: Path) -> ControllerSettings | Refusal:
    """The controller settings in a file: JSON where its name ends in .json, YAML otherwise."""
    return read_file(ControllerSettings, path, Code.INVALID_REQUEST)


def controller_from(data: Any, source: str = "controller") -> ControllerSettings | Refusal:
    """The controller settings in plain data, as from a JSON request."""
    return read_data(ControllerSettings, data, Code.INVALID_REQUEST, source)
