"""The force loop at each amplitude: K_1, K_2 and τ, open and closed loop, margins."""

from functools import lru_cache

from app.analysis.force_loop import ForceLoop
from app.analysis.linear import Coefficients, coefficients, linear_rig
from app.analysis.response.extremes import find_extremes
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.definitions.limits import RIG
from app.errors import Code, Fault, Refusal
from app.sheets.asked import LinearAsked
from app.sheets.curves import Floats, curve, extreme, grid, margins_out, response
from app.sheets.schemas import LinearSheet, LoopAt
from rtcore.rig.linear import StateSpace
from rtcore.rig.parameters import RigParameters


@lru_cache(maxsize=64)
def linearised(rig: RigParameters, amplitude_n: float, mean_n: float) -> StateSpace | Refusal:
    """The rig's state space, kept: whoever types gains asks for the same one again and again."""
    try:
        return linear_rig(rig, amplitude_n, mean_n)
    except ValueError as error:
        fault = Fault("mean_n", mean_n, f"a mean that it can hold: {error}")
        return Refusal(Code.INVALID_REQUEST, f"mean_n: {error}", (fault,))


@lru_cache(maxsize=256)
def _coefficients(rig: RigParameters, amplitude_n: float, mean_n: float) -> Coefficients:
    return coefficients(rig, amplitude_n, mean_n)


@lru_cache(maxsize=32)  # what is in force is asked for again beside every draft
def linear_sheet(
    rig: RigParameters, controller: ControllerSettings, asked: LinearAsked
) -> LinearSheet | Refusal:
    """The loop of a rig under a controller, for loads of some amplitudes."""
    frequencies, loops = grid(asked), []
    for amplitude in asked.amplitude_n:
        found = linearised(rig, amplitude, asked.mean_n)
        if isinstance(found, Refusal):
            return found
        loop = ForceLoop(found, to_record(controller), RIG.period_s, asked.load_hz)
        loops.append(_at(rig, loop, (amplitude, asked.mean_n), frequencies))
    return LinearSheet(load_hz=asked.load_hz, frequencies_hz=curve(frequencies), loops=loops)


def _at(
    rig: RigParameters, loop: ForceLoop, load_n: tuple[float, float], frequencies_hz: Floats
) -> LoopAt:
    closed = loop.closed_loops(frequencies_hz)
    of_rig = _coefficients(rig, *load_n)
    seen = find_extremes(frequencies_hz, closed)
    return LoopAt(
        amplitude_n=load_n[0],
        mean_n=load_n[1],
        k_1_n=of_rig.k_1_n,
        k_2_n_s_m=of_rig.k_2_n_s_m,
        tau_s=of_rig.tau_s,
        margins=margins_out(loop.margins()),
        open_loop=response(loop.open_loops(frequencies_hz)),
        closed_loop=response(closed),
        peak=extreme(seen.peak),
        dip=extreme(seen.dip),
    )
