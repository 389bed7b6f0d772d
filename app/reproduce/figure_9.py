"""Figure 9: what a harmonic load does to the velocity signal: the unit unloaded, and loaded."""

import numpy as np
from matplotlib.figure import Figure as Canvas

from app.reports.figures.colours import MEASURED
from app.reports.figures.style import canvas
from app.reproduce.made import Beside, Floats, Progress, Reproduced, Sheet
from app.reproduce.playing import PERIOD_S, Played, fitted, play, times
from rtcore.rig.parameters import load_rig

LOAD_N, LOAD_HZ, MOTION_HZ, COMMAND_M = 2000.0, 50.0, 4.0, 2.073e-3
FROM_S, LASTS_S, SHOWN_S = 1.5, 2.0, 0.5


def make(progress: Progress) -> Reproduced:
    """The LVT while the unit moves 2 mm at 4 Hz, without a load and with 2 kN at 50 Hz."""
    lasts = {"duration_s": FROM_S + LASTS_S + 0.5}
    motion = {"kind": "harmonic", "amplitude_m": COMMAND_M, "frequency_hz": MOTION_HZ} | lasts
    load = {"kind": "harmonic", "amplitude_n": LOAD_N, "frequency_hz": LOAD_HZ} | lasts
    unloaded = play([{"kind": "hold", "force_n": 0} | lasts], [motion], compensation="off")
    progress(0.5)
    loaded = play([load], [motion], compensation="off")
    progress(1.0)
    time_s = times(round(LASTS_S / PERIOD_S))
    free, bent = _velocity(unloaded), _velocity(loaded)
    force = abs(fitted(_part(loaded, "force_n"), LOAD_HZ))
    columns = {"time_s": time_s, "unloaded_m_s": free, "loaded_m_s": bent}
    return Reproduced(
        "figure-9",
        "Effect of harmonic load on the TRA speed F/B",
        tuple(_numbers(free, bent, force)),
        (Sheet("velocity", columns),),
        lambda: _draw(time_s, free, bent),
        (
            "The paper's text gives no numbers for this figure. Its message is reproduced: under load the "
            "velocity signal has the deformation of the chain in it, here a third of the motion's own; it "
            "grows with the load and with its frequency.",
            "The closed form, Y_0 dF/dt with Y_0 = 1/k_TRA + 1/k_2 + 1/k_LC + 1/k_Pl, leaves out the masses "
            "between, which add 2 % at 50 Hz.",
        ),
    )


def _part(run: Played, name: str) -> Floats:
    first = round(FROM_S / PERIOD_S)
    return run.channel(name)[first : first + round(LASTS_S / PERIOD_S)]


def _velocity(run: Played) -> Floats:
    return _part(run, "velocity_m_s")


def _numbers(free: Floats, bent: Floats, force_n: float) -> list[Beside]:
    s, unit = load_rig().structure, load_rig().unit
    yields = 1 / unit.k_tra + 1 / s.k_2 + 1 / s.k_lc + 1 / s.k_pl
    moved = 2.0 * np.pi * MOTION_HZ * 2.0e-3
    bends = float(yields * 2.0 * np.pi * LOAD_HZ * force_n)
    at = {
        name: [abs(fitted(v, f)) for f in (MOTION_HZ, LOAD_HZ)]
        for name, v in (("free", free), ("bent", bent))
    }
    return [
        Beside(
            "Unloaded, at 4 Hz", "m/s", at["free"][0], sheet=moved, note="closed form: 2 mm at 4 Hz"
        ),
        Beside("Unloaded, at 50 Hz", "m/s", at["free"][1]),
        Beside("Loaded, at 4 Hz", "m/s", at["bent"][0], sheet=moved),
        Beside(
            "Loaded, at 50 Hz", "m/s", at["bent"][1], sheet=bends, note="closed form: Y_0 dF/dt"
        ),
        Beside("Deformation over motion", "1", at["bent"][1] / at["bent"][0]),
    ]


def _draw(time_s: Floats, free: Floats, bent: Floats) -> Canvas:
    drawn = canvas(95.0)
    shown = slice(0, round(SHOWN_S / PERIOD_S))
    every = drawn.subplots(2, 1, sharex=True, sharey=True)
    titles = ("The unit moves, unloaded", "The unit moves under a harmonic load")
    for axes, values, title in zip(every, (free, bent), titles, strict=True):
        axes.plot(time_s[shown] * 1e3, values[shown] * 1e3, color=MEASURED, lw=0.8)
        axes.set_ylabel("LVT (mm/s)")
        axes.set_title(title, fontsize=7.0, loc="left")
        axes.margins(x=0.0)
    every[-1].set_xlabel("Time (ms)")
    return drawn
