"""Records of the control law for its tests."""

from typing import Any

import numpy as np

from rtcore.control.law import LAW, adopt_gains, open_loop
from tests.unit.rtcore import programs

PERIOD_S = 250e-6
NO_FEEDBACK = {"k_p": 0.0, "k_i": 0.0, "k_d": 0.0, "k_ff": 0.0}


def gains(**other: float) -> Any:
    """A GAINS record: those of the sheet with some changed."""
    record = programs.gains()
    for name, value in other.items():
        record[name] = value
    return record


def law(of: Any) -> Any:
    """A LAW record that has adopted gains and stands open."""
    record = np.zeros(1, LAW)[0]
    adopt_gains(of, record, PERIOD_S)
    open_loop(record, 0.0, 0.0)
    return record
