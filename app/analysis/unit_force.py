"""The force on the unit under test: what the load cell reads, less the inertia of the masses behind it.

Load cell → mass 1 → mass 2 → unit, so F_unit = F_cell − (m_1 + m_2)·a, with the acceleration a of their
centre. They move with the rod but for what load cell and fixture yield, and the rod's velocity v is measured
against the body of the load actuator, which swings on its plate. That is followed by its own equation of
motion, (m_B + m_LA)·x_B'' + c_Pl·x_B' + k_Pl·x_B = −F − m_LA·v', and so a = v' + x_B'' − y·F''.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

from rtcore.compiled import entry
from rtcore.rig.parameters import RigParameters

REACH = 2  # ticks on either side that one value needs
Floats = npt.NDArray[np.float64]
_AT = np.dtype([("begun", "?"), ("driven", "f8"), ("x_m", "f8"), ("v_m_s", "f8")])


class Chain(NamedTuple):
    """What of the rig the correction needs; SI."""

    mass_kg: float  # m_1 + m_2
    rod_kg: float
    body_kg: float
    plate_n_m: float
    plate_n_s_m: float
    yields_m_n: float  # y: of load cell and fixture, to the centre of the masses

    @staticmethod
    def of(rig: RigParameters) -> "Chain":
        """From the parameters of a rig."""
        part = rig.structure
        mass_kg = part.m_1_kg + part.m_2_kg
        yields_m_n = 1 / part.k_lc + part.m_2_kg / mass_kg / part.k_2
        return Chain(mass_kg, part.m_la_kg, part.m_b_kg, part.k_pl, part.c_pl, yields_m_n)


class Inertia:
    """The force that the masses take, piece after piece of a run."""

    def __init__(self, chain: Chain, period_s: float) -> None:
        self._chain = chain
        self._period_s = period_s
        self._moves, self._drives = _body(chain, period_s)
        self._at = np.zeros(1, _AT)

    def take(
        self, force_n: npt.NDArray[np.floating], velocity_m_s: npt.NDArray[np.floating]
    ) -> Floats:
        """(n − 2·REACH,) N at all of (n,) consecutive ticks but the outer; the next piece begins with those.

        So the last 2·REACH ticks of a piece are the first of the next one.
        """
        found = np.empty(max(0, len(force_n) - 2 * REACH))
        chain = self._chain
        _inertia(
            self._at,
            np.require(force_n, np.float64, ["C", "W"]),
            np.require(velocity_m_s, np.float64, ["C", "W"]),
            self._moves,
            self._drives,
            np.array(
                [chain.mass_kg, chain.rod_kg, chain.body_kg, chain.plate_n_m, chain.plate_n_s_m]
            ),
            chain.yields_m_n,
            self._period_s,
            found,
        )
        return found

    def restart(self) -> None:
        """The next piece does not follow the one before: the body is taken to be at rest."""
        self._at["begun"] = False


def noise_gains(chain: Chain, period_s: float, ticks: int = 2000) -> tuple[float, float]:
    """What 1 N of white noise in the force adds to the corrected force beyond itself, and 1 m/s in the velocity."""
    pulse, none = np.zeros(ticks), np.zeros(ticks)
    pulse[ticks // 4] = 1.0
    of_force, of_velocity = (
        Inertia(chain, period_s).take(*of) for of in ((pulse, none), (none, pulse))
    )
    apart = of_force.copy()
    apart[ticks // 4 - REACH] -= 1.0  # the reading itself
    gain = float(np.sqrt(max(0.0, np.sum(apart**2) - 1.0)))
    return gain, float(np.sqrt(np.sum(of_velocity**2)))


def _body(chain: Chain, period_s: float) -> tuple[Floats, Floats]:
    """(2, 2) by which position and velocity of the body move on in a tick, and (2, 2) by the driving force
    at its beginning and its end, which is taken to change evenly in between."""
    mass_kg = chain.body_kg + chain.rod_kg
    system = np.zeros((4, 4))
    system[0, 1], system[1, 2], system[2, 3] = 1.0, 1 / mass_kg, 1.0
    system[1, 0], system[1, 1] = -chain.plate_n_m / mass_kg, -chain.plate_n_s_m / mass_kg
    step = expm(system * period_s)
    at_end = step[:2, 3] / period_s
    drives = np.column_stack([step[:2, 2] - at_end, at_end])
    return np.ascontiguousarray(step[:2, :2]), np.ascontiguousarray(drives)


@entry
def _inertia(
    state: npt.NDArray[np.void],
    force: Floats,
    velocity: Floats,
    moves: Floats,
    drives: Floats,
    parts: Floats,
    yields_m_n: float,
    period_s: float,
    found: Floats,
) -> None:
    at = state[0]
    mass, rod, body, plate, damping = parts[0], parts[1], parts[2], parts[3], parts[4]
    second = 1.0 / (2 * period_s) ** 2
    for k in range(len(found)):
        c = k + REACH
        slope = (velocity[c + 1] - velocity[c - 1]) / (2 * period_s)
        driven = -force[c] - rod * slope
        if at.begun:
            x = moves[0, 0] * at.x_m + moves[0, 1] * at.v_m_s
            v = moves[1, 0] * at.x_m + moves[1, 1] * at.v_m_s
            at.x_m = x + drives[0, 0] * at.driven + drives[0, 1] * driven
            at.v_m_s = v + drives[1, 0] * at.driven + drives[1, 1] * driven
        else:
            at.begun = True
            at.x_m, at.v_m_s = driven / plate, 0.0
        at.driven = driven
        swings = (driven - plate * at.x_m - damping * at.v_m_s) / (body + rod)
        bend = (force[c + 2] - 2 * force[c] + force[c - 2]) * second
        found[k] = mass * (slope + swings - yields_m_n * bend)
