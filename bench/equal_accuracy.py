"""At which tolerance scipy's LSODA is as exact as the tick, on a stretch of a test."""

from dataclasses import dataclass
from typing import Any, NamedTuple

from app.definitions.definition import Definition
from app.definitions.library import library
from app.definitions.windows import windows
from bench.recorded import Recording, begin, quiet_rig, ready_rig, record
from bench.references import (
    PERIOD_S,
    TickSolver,
    lsoda,
    odeint_lsoda,
    radau,
    solver_states,
)
from bench.replays import TOLERANCE, force_error
from rtcore.modes import Mode
from rtcore.rig.constants import plant_constants
from rtcore.rig.parameters import RigParameters
from rtcore.virtual import Virtual

SOLVERS: dict[str, TickSolver] = {"solve_ivp": lsoda, "odeint": odeint_lsoda}
LONGEST_TICKS = 1_000_000
TOLERANCES = [10.0 ** (-2.0 - k / 8.0) for k in range(49)]  # 1e-2 to 1e-8


class Case(NamedTuple):
    """A test of the library, and how much is replayed from its first step or full cycle on."""

    test_id: str
    what: str
    replayed_s: float

    @property
    def test(self) -> Definition:
        """Its definition."""
        return library()[self.test_id]

    @property
    def first_tick(self) -> int:
        """Of the first step or full cycle."""
        found = windows(self.test, LONGEST_TICKS)
        steps, cycles = [s.first for s in found.steps], [first for first, _ in found.cycles]
        return min(steps + cycles)


CASES = (
    Case("harmonic-2-kn-50-hz-moving", "2 kN at 50 Hz, unit moving", 0.06),
    Case("step-2-kn", "step of 2 kN", 0.06),
)


@dataclass(frozen=True)
class Matched:
    """A stretch of a test, the tick's worst force error in it (share of peak), and by solver the
    coarsest tolerance that is at least as exact, with its own error."""

    case: Case
    plant: Any
    run: Recording
    own_error: float
    solvers: dict[str, tuple[float, float]]


def started(case: Case, rig: RigParameters) -> Virtual:
    """A rig that is about to begin a test's first step or cycle. Raises RuntimeError where it is not."""
    virtual = ready_rig(rig)
    begin(virtual, case.test)
    virtual.advance(case.first_tick - 1)  # the first of all has been run
    if virtual.mode is not Mode.RUNNING:
        raise RuntimeError(f"{case.test_id}: {virtual.mode.name.lower()}")
    return virtual


def match(case: Case) -> Matched:
    """Replay a stretch with Radau, then with ever finer tolerances until each solver is as exact as the tick.

    Raises RuntimeError where one never is.
    """
    plant = plant_constants(quiet_rig())
    run = record(started(case, quiet_rig()), round(case.replayed_s / PERIOD_S))
    truth = solver_states(radau, plant, run.before, run.inputs, TOLERANCE)
    own_error = force_error(run.states, truth)
    solvers = {}
    for name, solver in SOLVERS.items():
        for tolerance in TOLERANCES:
            states = solver_states(solver, plant, run.before, run.inputs, tolerance)
            error = force_error(states, truth)
            if error <= own_error:
                solvers[name] = tolerance, error
                break
        else:
            raise RuntimeError(f"{name} is never as exact as the tick in {case.what}")
    return Matched(case, plant, run, own_error, solvers)
