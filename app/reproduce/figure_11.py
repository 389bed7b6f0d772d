"""Figure 11: Bode plot of the velocity filtering branch for a harmonic load of 40 Hz."""

import numpy as np
from matplotlib.figure import Figure as Canvas

from app.controller.presets import COMPENSATORS
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.reports.figures.bode import Bode, Marked, Response, draw_bode
from app.reproduce.made import Beside, Floats, Progress, Reproduced, Sheet
from app.reproduce.playing import PERIOD_S, fitted, play
from rtcore.control.response import branch_response, shift

LOAD_HZ, LOAD_N = 40.0, 500.0
MOTIONS_HZ = (1.0, 2.0, 4.0, 6.0, 8.0, 12.0)
LARGEST_M, LARGEST_M_S = 2e-3, 0.04
FROM_S, LASTS_S = 2.0, 4.0


def make(progress: Progress) -> Reproduced:
    """The branch of each shipped compensator in closed form, and that in force measured at the tick."""
    frequencies = np.geomspace(0.5, 400.0, 400)
    branches = {name: _branch(name, frequencies) for name in COMPENSATORS}
    measured = np.array([_measured(f, progress, i) for i, f in enumerate(MOTIONS_HZ)])
    closed = _branch("COMP4", np.array(MOTIONS_HZ))
    sheets = [
        Sheet(name, {"frequency_hz": frequencies, "gain": np.abs(h), "phase_deg": _phase(h)})
        for name, h in branches.items()
    ]
    at = np.array(MOTIONS_HZ)
    sheets.append(
        Sheet(
            "measured_COMP4",
            {
                "frequency_hz": at,
                "gain": np.abs(measured),
                "phase_deg": np.degrees(np.angle(measured)),
            },
        )
    )
    return Reproduced(
        "figure-11",
        "Bode plot of the velocity filtering branch",
        tuple(_numbers(measured, closed, branches, frequencies)),
        tuple(sheets),
        lambda: _draw(sheets),
        (
            "The paper gives neither corner frequencies nor gains. Its branch attenuates low frequencies and "
            "leads in phase above; ours (lead, low-pass, notch on the load) has the same parts, in the order "
            "lead from 1 to 3 Hz (COMP4) or to 20 Hz (COMP8), and falls above 8 to 14 Hz, where the unit "
            "hardly moves.",
            "The points are the loop's own branch under a 40 Hz load while the unit moves at each frequency, "
            "velocity in to compensation out, divided by FF_V.",
        ),
    )


def _branch(name: str, frequencies_hz: Floats) -> np.ndarray:
    gains = to_record(ControllerSettings.model_validate({"compensator": name}))
    return np.array(
        [
            branch_response(gains, LOAD_HZ, shift(float(f), PERIOD_S), PERIOD_S)
            for f in frequencies_hz
        ]
    )


def _measured(frequency_hz: float, progress: Progress, i: int) -> complex:
    """Velocity to filtered velocity, of the tick, at one frequency of the unit's motion."""
    turn = 2.0 * np.pi * frequency_hz
    amplitude = min(LARGEST_M, LARGEST_M_S / turn)
    lasts = {"duration_s": FROM_S + LASTS_S + 0.5}
    load = {"kind": "harmonic", "amplitude_n": LOAD_N, "frequency_hz": LOAD_HZ} | lasts
    motion = {"kind": "harmonic", "amplitude_m": amplitude, "frequency_hz": frequency_hz} | lasts
    run = play([load], [motion], compensation="on")
    progress((i + 1) / len(MOTIONS_HZ))
    part = slice(round(FROM_S / PERIOD_S), round((FROM_S + LASTS_S) / PERIOD_S))
    ff_v = float(to_record(ControllerSettings())["ff_v"])
    out = fitted(run.channel("compensation_velocity")[part], frequency_hz) / ff_v
    return out / fitted(run.channel("velocity_m_s")[part], frequency_hz)


def _phase(h: np.ndarray) -> Floats:
    return np.asarray(np.degrees(np.unwrap(np.angle(h))))


def _decibels(h: np.ndarray | complex) -> Floats:
    return np.asarray(20.0 * np.log10(np.maximum(np.abs(h), 1e-9)))


def _numbers(
    measured: np.ndarray, closed: np.ndarray, branches: dict[str, np.ndarray], frequencies: Floats
) -> list[Beside]:
    gain = float(np.max(np.abs(_decibels(measured) - _decibels(closed))))
    turned = np.degrees(np.angle(measured / closed))
    leads = {
        name: float(np.max(_phase(h)[frequencies < LOAD_HZ / 2])) for name, h in branches.items()
    }
    notch = float(_decibels(_branch("COMP4", np.array([LOAD_HZ])))[0])
    found = [
        Beside(
            "Notch at 40 Hz", "dB", max(notch, -120.0), note="−∞ in theory; at most −120 is written"
        ),
        Beside("Tick against closed form, gain, worst", "dB", gain, sheet=0.0),
        Beside(
            "Tick against closed form, phase, worst", "°", float(np.max(np.abs(turned))), sheet=0.0
        ),
    ]
    return found + [
        Beside(f"Largest phase lead below 20 Hz, {name}", "°", lead) for name, lead in leads.items()
    ]


def _draw(sheets: list[Sheet]) -> Canvas:
    responses = [
        Response(
            sheet.name.replace("measured_COMP4", "tick, COMP4"),
            sheet.columns["frequency_hz"],
            np.maximum(_decibels(sheet.columns["gain"]), -60.0),
            sheet.columns["phase_deg"],
        )
        for sheet in sheets
    ]
    marked = [Marked(LOAD_HZ, -60.0, "notch at the load's 40 Hz")]
    return draw_bode(Bode(responses, marked))
