"""The unit under test's own response, behind the load cell and the masses that stand before it.

Load cell, LVT and LVDT see force and motion elsewhere in the chain: body on its plate – rod – load cell –
mass 1 – mass 2 – unit. From the force in the load cell and the rod's motion against the body, the known
parts of the chain give the force on the unit and how far it gives way, at each frequency exactly.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from app.analysis.phasors import Complex
from app.analysis.response.fit import Estimate, Fit
from app.analysis.response.periods import Realisation
from app.analysis.response.transfers import UNIT_TRANSFERS, Transfer
from rtcore.compiled import Array
from rtcore.rig.parameters import RigParameters

FORCE, VELOCITY, DISPLACEMENT = "force_n", "velocity_m_s", "displacement_m"
COMMAND = "displacement_command_m"
# That the channels which a unit's response needs are among those that are fitted.
MEASURED = Transfer("", VELOCITY, DISPLACEMENT, "", "")


def unit_estimates(
    fit: Fit, rig: RigParameters, frequency_hz: float
) -> dict[Transfer, Estimate | None]:
    """Dynamic stiffness and admittance of the unit from a fit of load cell, LVT and LVDT."""
    seen = unit_weights(rig, frequency_hz)
    at = [fit.channels.index(name) for name in (FORCE, VELOCITY, DISPLACEMENT)]
    weights = np.zeros((2, len(fit.channels)), np.complex128)
    weights[:, at] = seen
    force, deformation = weights
    speed = 2j * np.pi * frequency_hz * deformation
    return {
        UNIT_TRANSFERS["stiffness"]: fit.ratio(deformation, force),
        UNIT_TRANSFERS["admittance"]: fit.ratio(force, speed),
    }


@lru_cache(maxsize=4096)
def unit_weights(rig: RigParameters, frequency_hz: float) -> Complex:
    """(2, 3): force on the unit (N) and its deformation (m), from load cell, LVT and LVDT, at a frequency.

    All are channels of the same tick. The chains of load cell and LVT are taken off.
    """
    s = 2j * np.pi * frequency_hz
    part, sensors = rig.structure, rig.sensors
    w = sensors.omega_lc_rad_s
    force, velocity, moved = np.eye(3, dtype=np.complex128)
    force = force * (s**2 + 2 * sensors.zeta_lc * w * s + w**2) / w**2
    stroke = velocity * (s + sensors.omega_lvt_rad_s) / sensors.omega_lvt_rad_s / s
    plate = (part.m_b_kg + part.m_la_kg) * s**2 + part.c_pl * s + part.k_pl
    body = -(force + part.m_la_kg * s**2 * stroke) / plate
    mass_1 = body + stroke - force / (part.k_lc + part.c_lc * s)
    fixture = force - part.m_1_kg * s**2 * mass_1
    mass_2 = mass_1 - fixture / (part.k_2 + part.c_2 * s)
    on_unit = fixture - part.m_2_kg * s**2 * mass_2
    return np.array([on_unit, mass_2 - moved])


def command_as_it_acts(realisation: Realisation, tick_hz: float, period_ticks: int) -> Realisation:
    """The same realisation with the unit's command as it comes to the unit.

    The command of a tick acts a tick later and is held for one: that is the loop's, and not the unit's own.
    """
    acts = np.ones(realisation.mean.shape, np.complex128)
    frequencies_hz = realisation.lines * tick_hz / period_ticks
    acts[realisation.channels.index(COMMAND)] = held_a_tick_later(frequencies_hz, 1 / tick_hz)
    both = acts.T[:, :, None] * acts.T[:, None, :].conj()
    return replace(realisation, mean=realisation.mean * acts, noise=realisation.noise * both)


def servo(rig: RigParameters, frequencies_hz: Array) -> Complex:
    """(n,) the model's position response: the unit's servo of second order."""
    s, w = 2j * np.pi * np.asarray(frequencies_hz), rig.unit.omega_t_rad_s
    return np.asarray(w**2 / (s**2 + 2 * rig.unit.zeta_t * w * s + w**2))


def held_a_tick_later(frequencies_hz: Array, period_s: float) -> Complex:
    """(n,) what becomes of a recorded command until it acts: a tick of delay, then the hold."""
    cycles = np.asarray(frequencies_hz) * period_s
    return np.asarray(np.exp(-3j * np.pi * cycles) * np.sinc(cycles))
