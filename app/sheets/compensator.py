"""The compensation branch part by part, the loop with it and without, and its exact tuning (figure 11)."""

import cmath
import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from app.analysis.branch import branch_parts
from app.analysis.force_loop import ForceLoop, exact_compensation
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.definitions.limits import RIG
from app.errors import Refusal
from app.sheets.asked import CompensatorAsked
from app.sheets.curves import Floats, curve, grid, in_db, margins_out, response
from app.sheets.linear import linearised
from app.sheets.schemas import CompensatorSheet, LoopBeside, LoopResponse, Tuning
from rtcore.control.response import compensation_response, quadrature_gains, shift
from rtcore.rig.parameters import RigParameters


@lru_cache(maxsize=32)  # what is in force is asked for again beside every draft
def compensator_sheet(
    rig: RigParameters, controller: ControllerSettings, asked: CompensatorAsked
) -> CompensatorSheet | Refusal:
    """The compensator of a controller on a rig, under a load of one frequency."""
    found = linearised(rig, asked.amplitude_n, asked.mean_n)
    if isinstance(found, Refusal):
        return found
    frequencies = grid(asked)
    loop = ForceLoop(found, to_record(controller), RIG.period_s, asked.load_hz)
    without = replace(loop, load_hz=None)
    left = loop.disturbances(frequencies) / without.disturbances(frequencies)
    return CompensatorSheet(
        load_hz=asked.load_hz,
        amplitude_n=asked.amplitude_n,
        mean_n=asked.mean_n,
        frequencies_hz=curve(frequencies),
        **_branches(loop, asked.load_hz, frequencies),
        with_branch=_beside(loop, frequencies),
        without_branch=_beside(without, frequencies),
        disturbance_db=curve(in_db(left)),
        tuning=None if asked.tune_hz is None else tuning(loop, asked.tune_hz),
    )


def tuning(loop: ForceLoop, frequency_hz: float) -> Tuning:
    """The gains with which a motion of one frequency moves the force no more."""
    wanted = exact_compensation(loop.rig, frequency_hz, loop.period_s)
    z = shift(frequency_hz, loop.period_s)
    ff_v, ff_a = quadrature_gains(loop.gains, wanted, loop.load_hz, z, loop.period_s)
    return Tuning(
        frequency_hz=frequency_hz,
        ff_v=ff_v,
        ff_a=ff_a,
        gain=abs(wanted),
        phase_deg=math.degrees(cmath.phase(wanted)),
    )


def _branches(loop: ForceLoop, load_hz: float, frequencies_hz: Floats) -> dict[str, LoopResponse]:
    z = np.array([shift(f, loop.period_s) for f in frequencies_hz])
    lead, low_pass, notch = branch_parts(loop.gains, load_hz, z, loop.period_s)
    fed = [compensation_response(loop.gains, load_hz, at, loop.period_s) for at in z]
    return {
        "lead": response(lead),
        "low_pass": response(low_pass),
        "notch": response(notch),
        "whole": response(lead * low_pass * notch),
        "compensation": response(np.array(fed)),
    }


def _beside(loop: ForceLoop, frequencies_hz: Floats) -> LoopBeside:
    return LoopBeside(
        response=response(loop.open_loops(frequencies_hz)), margins=margins_out(loop.margins())
    )
