"""The compensators that ship with forcerig, tuned on the rig of the data sheet."""

from collections.abc import Mapping
from typing import Any

COMPENSATORS: Mapping[str, Mapping[str, Any]] = {
    # exact quadrature tuning at 4 Hz
    "COMP4": {
        "ff_v": 1.9607,
        "ff_a": 0.010862,
        "lead_zero_hz": 1.0,
        "lead_pole_hz": 3.0,
        "low_pass_hz": 8.0,
        "low_pass_order": 1,
        "notch_damping": 0.15,
    },
    # exact quadrature tuning at 8 Hz
    "COMP8": {
        "ff_v": 4.2148,
        "ff_a": 0.0097056,
        "lead_zero_hz": 1.0,
        "lead_pole_hz": 20.0,
        "low_pass_hz": 12.0,
        "low_pass_order": 2,
        "low_pass_damping": 0.7,
        "notch_damping": 0.15,
    },
    # 1 to 15 Hz, tuned nowhere exactly
    "BROAD": {
        "ff_v": 3.995,
        "ff_a": 0.007513,
        "lead_zero_hz": 58.3,
        "lead_pole_hz": 176.0,
        "low_pass_hz": 14.17,
        "low_pass_order": 1,
        "notch_damping": 0.1,
    },
}
DEFAULT_COMPENSATOR = "COMP4"
