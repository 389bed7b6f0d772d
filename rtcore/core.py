"""What the tick remembers from one tick to the next: the loop's private record."""

from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.control.law import LAW
from rtcore.interlocks import MAX_DETECTORS, Quantity
from rtcore.io import INPUTS, OUTPUTS
from rtcore.modes import Mode
from rtcore.program.generator import GENERATOR

SETTINGS = np.dtype(
    [
        ("period_s", "f8"),
        ("ready_pa", "f8"),  # supply pressure from which the rig is ready
        ("low_reached_pa", "f8"),  # from which the supply goes from low to high
        ("low_ticks", "i8"),  # how long it stays at low at least
        ("hold_fade_ticks", "i8"),
        ("stop_fade_ticks", "i8"),
        ("force_range_n", "f8"),  # of the converters: beyond it a reading is saturated
        ("velocity_range_m_s", "f8"),
        ("displacement_range_m", "f8"),
        ("force_limit_n", "f8"),  # of a program
        ("displacement_limit_m", "f8"),
        (
            "frozen_ticks",
            "i8",
        ),  # a noisy sensor that repeats itself this long is frozen, 0: not looked at
        ("tare_share", "f8"),  # of a new reading in the tare's running mean
    ],
    align=True,
)

SENSOR = np.dtype([("last", "f8"), ("repeats", "i8")], align=True)

SAMPLE = np.dtype(
    [
        ("force_n", "f8"),  # tared
        ("displacement_m", "f8"),
        ("velocity_m_s", "f8"),
        ("faults", "i8"),
        ("tare_n", "f8"),
        ("untared_mean_n", "f8"),
        ("force", SENSOR),
        ("velocity", SENSOR),
    ],
    align=True,
)

CORE = np.dtype(
    [
        ("settings", SETTINGS),
        ("tick", "i8"),
        ("mode", "i8"),
        ("mode_ticks", "i8"),  # ticks spent in this mode
        ("inputs", INPUTS),
        ("sample", SAMPLE),
        ("quantities", "f8", (len(Quantity),)),
        ("violated_ticks", "i8", (MAX_DETECTORS,)),
        ("trips", "u8"),
        ("violated", "u8"),  # detectors violated in this tick
        ("last_reply", "i8"),
        ("trip_after_stop", "i8"),  # a controlled stop that ends latched
        ("force", GENERATOR),
        ("motion", GENERATOR),
        ("law", LAW),
        ("outputs", OUTPUTS),
        ("run", "i8"),
        ("tail_ticks", "i8"),  # how much longer a run that has tripped is recorded
        ("has_program", "i8"),
        ("has_gains", "i8"),
        ("has_interlocks", "i8"),
        ("lease", "i8"),
        ("commands_seen", "i8"),
        ("checking_command", "i8"),  # which adoption the next field belongs to
        ("checked_segments", "i8"),  # of a program that waits to be adopted
        ("deadlines_missed", "i8"),
        ("missed_unreported", "i8"),
        ("latest_unreported_ns", "i8"),
        ("next_report_tick", "i8"),
    ],
    align=True,
)


def make_core(period_s: float, settings: dict[str, float]) -> npt.NDArray[Any]:
    """(1,) CORE as a loop begins: tripped, nothing loaded. `settings` overrides the defaults below."""
    cores = np.zeros(1, CORE)
    core = cores[0]

    def ticks(seconds: float) -> int:
        return max(1, round(seconds / period_s))

    defaults = {
        "period_s": period_s,
        "ready_pa": 19.0e6,
        "low_reached_pa": 5.0e6,
        "low_ticks": ticks(0.5),
        "hold_fade_ticks": ticks(0.25),
        "stop_fade_ticks": ticks(0.5),
        "force_range_n": 60e3,
        "velocity_range_m_s": 0.5,
        "displacement_range_m": 0.035,
        "force_limit_n": 50e3,
        "displacement_limit_m": 0.03,
        "frozen_ticks": ticks(0.05),
        "tare_share": period_s / 0.25,
    }
    for name, value in (defaults | settings).items():
        core["settings"][name] = value
    core["mode"] = Mode.TRIPPED
    core["checking_command"] = -1
    core["force"]["block"] = -1
    core["motion"]["block"] = -1
    return cores
