"""The greatest values around a first-out."""

from typing import Any

import numpy as np
import numpy.typing as npt

from app.first_outs.account import PeakKept
from rtcore.channels import CHANNEL

Records = npt.NDArray[Any]

PEAKS = (
    *("force_n", "force_error_n", "displacement_m"),
    *("velocity_m_s", "valve_command", "supply_pressure_pa"),
)


def peaks_of(records: Records, tick: int, period_s: float) -> list[PeakKept]:
    """The greatest magnitudes before a tick and from it on."""
    before, after = records[records["tick"] < tick], records[records["tick"] >= tick]
    found = []
    for name in PEAKS:
        value, _ = _peak(before, name)
        later, at = _peak(after, name)
        found.append(
            PeakKept(
                channel=name,
                unit=CHANNEL[name].unit,
                before=value,
                after=later,
                after_s=None if at is None else round((at - tick) * period_s, 9),
            )
        )
    return found


def _peak(records: Records, name: str) -> tuple[float | None, int | None]:
    """The value of the greatest magnitude, with its sign, and its tick."""
    sound = records[np.isfinite(records[name])]
    if not len(sound):
        return None, None
    at = int(np.argmax(np.abs(sound[name])))
    return float(sound[name][at]), int(sound["tick"][at])
