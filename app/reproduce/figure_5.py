"""Figure 5: static characteristic and force gain against the valve command, for several bypass orifices."""

import numpy as np
from matplotlib.figure import Figure as Canvas

from app.analysis.static import bypass_flow, force_gain, static_command, static_force
from app.reports.figures.style import SERIES, canvas
from app.reproduce.made import Beside, Floats, Progress, Reproduced, Sheet
from app.reproduce.playing import PERIOD_S, play
from app.sheets.static import with_orifice
from rtcore.rig.parameters import load_rig

DIAMETERS_M = (0.60e-3, 0.85e-3, 1.10e-3, 1.40e-3)
HELD_N = (2_000.0, 5_000.0, 10_000.0, 20_000.0, 30_000.0, 40_000.0, 50_000.0)
HOLD_S, READ_S = 1.5, 0.5
SHOWN = 0.4  # of the valve command: beyond that little happens


def make(progress: Progress) -> Reproduced:
    """Curves by eqs (1) to (3); forces that the whole rig holds, by the tick."""
    rig = load_rig()
    command = np.linspace(-1.0, 1.0, 401)
    rigs = [with_orifice(rig, diameter) for diameter in DIAMETERS_M]
    valve = held(progress)
    sheets = [
        Sheet(
            f"orifice_{1e3 * diameter:.2f}_mm",
            {
                "valve_command": command,
                "force_n": static_force(one, command),
                "bypass_flow_m3_s": bypass_flow(one, command),
                "force_gain_n": force_gain(one, command),
            },
        )
        for diameter, one in zip(DIAMETERS_M, rigs, strict=True)
    ]
    forces = np.array(HELD_N)
    sheets.append(Sheet("held_by_the_rig", {"valve_command": valve, "force_n": forces}))
    return Reproduced(
        "figure-5",
        "Static characteristic of the force control and system accuracy",
        tuple(_numbers(valve)),
        tuple(sheets),
        lambda: _draw(sheets),
        (
            "The paper gives neither axes' numbers nor K_o: its figure is reproduced in shape, and the "
            "authority of about 50 kN that it names in its text.",
            "The closed form leaves out leakage, laps and the laminar bypass; the points are the whole rig "
            "holding a force by its controller, and lie on the curve but for those.",
        ),
    )


def held(progress: Progress) -> Floats:
    """(n,) mean valve commands with which the rig holds the forces, by the very tick."""
    blocks = []
    for force_n in HELD_N:
        blocks.append({"kind": "ramp", "to_n": force_n, "rate_n_s": 50_000})
        blocks.append({"kind": "hold", "force_n": force_n, "duration_s": HOLD_S})
    played = play([*blocks, {"kind": "ramp", "to_n": 0, "rate_n_s": 50_000}])
    progress(1.0)
    block, valve = played.records["block"], played.channel("valve_command")
    last = round(READ_S / PERIOD_S)
    return np.array([np.mean(valve[block == 2 * i + 1][-last:]) for i in range(len(HELD_N))])


def _numbers(valve: Floats) -> list[Beside]:
    rig = load_rig()
    authority = float(static_force(rig, np.array([1.0]))[0])
    found = [
        Beside(
            "Greatest force", "N", authority, paper=50_000.0, sheet=53_500.0, note="“about 50 kN”"
        ),
        Beside("Valve command that holds 50 kN", "1", float(valve[-1]), sheet=0.18),
    ]
    for force_n, command in zip(HELD_N, valve, strict=True):
        closed = static_command(rig, force_n)
        note = "sheet: eqs (1) to (3)"
        what = f"Valve command that holds {force_n / 1e3:g} kN"
        if force_n != HELD_N[-1]:
            found.append(Beside(what, "1", float(command), sheet=closed, note=note))
    return found


def _draw(sheets: list[Sheet]) -> Canvas:
    drawn = canvas(88.0)
    left, flow, gain = drawn.subplots(1, 3)
    for sheet, (colour, dash, _) in zip(sheets[:-1], SERIES, strict=False):
        c, style = sheet.columns, {"color": colour, "ls": dash}
        label = sheet.name.removeprefix("orifice_").replace("_", " ")
        left.plot(c["valve_command"], c["force_n"] / 1e3, label=f"orifice {label}", **style)
        flow.plot(c["valve_command"], c["bypass_flow_m3_s"] * 6e4, **style)
        gain.plot(c["valve_command"], c["force_gain_n"] / 1e3, **style)
    points = sheets[-1].columns
    left.plot(
        points["valve_command"], points["force_n"] / 1e3, "ok", ms=3.0, mfc="none", label="rig"
    )
    titles = ("Force (kN)", "Bypass flow (l/min)", "Force gain (kN, whole stroke)")
    for axes, title in zip((left, flow, gain), titles, strict=True):
        axes.set_xlabel("Valve command")
        axes.set_title(title, fontsize=7.0, loc="left")
        axes.set_xlim(-SHOWN, SHOWN)
    drawn.legend(loc="outside upper right", ncols=5)
    return drawn
