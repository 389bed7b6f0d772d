"""What the tick remembers from one tick to the next: the loop's private record."""

from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.control.law import LAW
from rtcore.interlocks import MAX_DETECTORS, TREND
from rtcore.io import FAULT_SLOTS, INPUTS, OUTPUTS
from rtcore.modes import Mode
from rtcore.program.generator import GENERATOR
from rtcore.quantities import OBSERVED

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
        ("pressure_range_pa", "f8"),
        ("pressure_offset_pa", "f8"),  # that a sound sensor may read below nothing
        ("force_noise_n", "f8"),  # roughness of a sound sensor, 0: it has none
        ("velocity_noise_m_s", "f8"),
        ("area_m2", "f8"),
        ("force_implausible_n", "f8"),  # by which load cell and chambers may differ
        ("velocity_implausible_m_s", "f8"),  # in the mean, LVT and LVDT
        ("implausible_ticks", "i8"),
        ("force_limit_n", "f8"),  # of a program
        ("displacement_limit_m", "f8"),
        (
            "frozen_ticks",
            "i8",
        ),  # a noisy sensor that repeats itself this long is frozen, 0: not looked at
        ("tare_share", "f8"),  # of a new reading in the tare's running mean
        ("reset_edge_ticks", "i8"),  # two resets closer than this are one that is held down
        ("simulated", "i8"),  # whether the rig takes faults by command
    ],
    align=True,
)

SENSOR = np.dtype(
    [
        ("last", "f8"),
        ("before", "f8"),
        ("repeats", "i8"),
        ("roughness", "f8"),  # mean magnitude of the second difference
        ("noise", "f8"),  # what that is of a sound sensor
        ("range", "f8"),
        ("implausible_ticks", "i8"),
        ("fault", "i8"),  # a SensorFault
    ],
    align=True,
)

SAMPLE = np.dtype(
    [
        ("force_n", "f8"),  # tared
        ("displacement_m", "f8"),
        ("velocity_m_s", "f8"),
        ("apart_m_s", "f8"),  # LVT minus LVDT, in the mean
        ("tare_n", "f8"),
        ("untared_mean_n", "f8"),
        ("force", SENSOR),
        ("velocity", SENSOR),
        ("displacement", SENSOR),
        ("pressure", SENSOR),
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
        ("observed", OBSERVED),
        ("trends", TREND, (MAX_DETECTORS,)),
        ("judged", "f8", (MAX_DETECTORS,)),  # what each detector compares
        ("violated_ticks", "i8", (MAX_DETECTORS,)),
        ("trips", "u8"),
        ("violated", "u8"),  # detectors violated in this tick
        ("acting", "u8"),  # of them, those that do more than indicate
        ("blocking", "u8"),  # trips that keep the rig from being pressurised, started or resumed
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
        ("model_due", "i8"),  # the twin is to be of the model in force from its next move on
        ("lease", "i8"),
        ("stops_seen_ns", "i8"),
        ("last_reset_tick", "i8"),
        ("injected", "f8", (FAULT_SLOTS,)),  # into a simulated rig
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
        "pressure_range_pa": 40e6,
        "pressure_offset_pa": 0.2e6,
        "area_m2": 2.592e-3,
        "force_implausible_n": 5e3,
        "velocity_implausible_m_s": 0.1,
        "implausible_ticks": ticks(1e-3),
        "force_limit_n": 50e3,
        "displacement_limit_m": 0.03,
        "frozen_ticks": ticks(0.05),
        "tare_share": period_s / 0.25,
        "reset_edge_ticks": ticks(0.25),
    }
    for name, value in (defaults | settings).items():
        core["settings"][name] = value
    core["mode"] = Mode.TRIPPED
    core["checking_command"] = -1
    core["trends"]["last"] = np.nan
    core["last_reset_tick"] = -core["settings"]["reset_edge_ticks"]
    core["observed"]["block"] = -1
    for name, full_scale, noise in (
        ("force", "force_range_n", "force_noise_n"),
        ("velocity", "velocity_range_m_s", "velocity_noise_m_s"),
        ("displacement", "displacement_range_m", None),
        ("pressure", "pressure_range_pa", None),
    ):
        sensor = core["sample"][name]
        sensor["range"] = core["settings"][full_scale]
        sensor["noise"] = sensor["roughness"] = core["settings"][noise] if noise else 0.0
    core["force"]["block"] = -1
    core["motion"]["block"] = -1
    return cores
