"""The search: Gauss-Newton on what windows measured less what the model makes of them, within bounds.

Each channel weighs as much as its noise lets it, or as what remains of it where that is more (the output-error
method of Maine and Iliff). A prior of a factor e holds what the windows tell nothing of where it was.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydantic import ValidationError
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import lsq_linear

from app.identification.covariance import Known, Spectra, coloured_meat, combined
from app.identification.model import DISPLACEMENT, MEASURED, SPOOL, Model
from app.identification.parameters import Parameter, coordinates, placed
from app.identification.sensitivities import (
    Seen,
    Sensitivities,
    driven,
    in_threads,
    residual_of,
    root_mean_square,
)
from app.identification.windows import Window
from rtcore.rig.parameters import RigParameters

Floats = npt.NDArray[np.float64]
Progress = Callable[[float], None]

MOST_ITERATIONS = 12
FARTHEST = 0.7  # of a coordinate in one step: beyond, the model bends too much to be believed
SETTLED = 0.02  # deviations: a step that is smaller changes nothing that anybody could see
LEAST_STEP = 1e-7
HALVINGS = 6
PRIOR = 1.0  # deviation of a coordinate before anything is measured
PRIOR_ZERO_N = 1e4  # of a force zero
ALONE = {  # what spool and displacement tell by themselves
    "servovalve.omega_f_rad_s",
    "servovalve.zeta_f",
    "servovalve.spool_gain_rad_s",
    "unit.omega_t_rad_s",
    "unit.zeta_t",
}


@dataclass(frozen=True)
class Problem:
    """What is to be fitted to what: `noise` (7,) of the channels, `runs` how many there are."""

    rig: RigParameters
    wanted: Sequence[Parameter]
    windows: Sequence[Window]
    runs: int
    noise: Floats
    period_s: float
    threads: int = 1

    @property
    def prior(self) -> Floats:
        """(p,) deviations of all coordinates, the force zeros' last."""
        return np.array([PRIOR] * len(self.wanted) + [PRIOR_ZERO_N] * self.runs)


@dataclass(frozen=True)
class Fitted:
    """Where the search ended: `at` (p,) with the force zeros last, how well it is known, and what remained (7,)."""

    at: Floats
    known: Known
    remained: Floats
    weights: Floats
    iterations: int
    settled: bool


@dataclass(frozen=True)
class _Stage:
    """What is moved, (p,), and by which channels, (7,); from one share of the search to another."""

    free: npt.NDArray[np.bool_]
    channels: npt.NDArray[np.bool_]
    begins: float
    ends: float

    def share(self, iteration: int) -> float:
        """Half of what is left is done in each iteration or two."""
        return self.ends - (self.ends - self.begins) * 0.75 ** (iteration - 1)


def _stages(problem: Problem) -> Iterator[_Stage]:
    """Spool and unit depend on nothing else; what is wrong with them would mislead all the rest."""
    paths = [p.path for p in problem.wanted]
    first = np.array([path in ALONE for path in paths] + [False] * problem.runs)
    alone = np.isin(np.arange(len(MEASURED)), (SPOOL, DISPLACEMENT))
    if first.any():
        yield _Stage(first, alone, 0.0, 0.15)
    everything = np.ones(len(first), np.bool_), np.ones(len(MEASURED), np.bool_)
    yield _Stage(*everything, 0.15, 1.0)


class Search:
    """One search."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._n = len(problem.wanted)
        self._begun = np.append(coordinates(problem.rig, problem.wanted), np.zeros(problem.runs))
        bounds = [
            p.bounds(p.value(float(x)))
            for p, x in zip(problem.wanted, self._begun[: self._n], strict=True)
        ]
        free = [(-np.inf, np.inf)] * problem.runs
        self._low, self._high = np.array([*bounds, *free]).T

    def run(self, progress: Progress) -> Fitted:
        """Search until the steps are too small to matter: what channels of its own tell first, then everything."""
        at, iterations = self._begun.copy(), 0
        for stage in _stages(self._problem):
            at, seen, weights, took, settled = self._stage(stage, at, progress)
            iterations += took
        known = self._known(seen, weights)
        remained = root_mean_square(s.residual for s in seen)
        return Fitted(at, known, remained, weights, iterations, settled)

    def _stage(
        self, stage: "_Stage", at: Floats, progress: Progress
    ) -> tuple[Floats, list[Seen], Floats, int, bool]:
        for iteration in range(1, MOST_ITERATIONS + 1):
            progress(stage.share(iteration))
            seen = self._seen(at, stage.free)
            weights = np.maximum(self._problem.noise, root_mean_square(s.residual for s in seen))
            weights[~stage.channels] = np.inf
            inverse, step = self._step(at, seen, weights)
            small = SETTLED * np.sqrt(np.diag(inverse)) + LEAST_STEP
            settled = bool(np.all(np.abs(step) < small))
            moved = None if settled else self._along(at, step, weights)
            if moved is None:
                break
            at = moved
        return at, seen, weights, iteration, settled

    def _seen(self, at: Floats, free: npt.NDArray[np.bool_]) -> list[Seen]:
        p = self._problem
        there = Sensitivities(p.rig, p.wanted, at[: self._n], at[self._n :], p.period_s, free)
        return list(in_threads(there.seen, p.windows, p.threads))

    def _step(self, at: Floats, seen: Sequence[Seen], weights: Floats) -> tuple[Floats, Floats]:
        """The inverse information, and the bounded least-squares step."""
        prior = 1.0 / self._problem.prior**2
        total, pull = np.diag(prior), prior * (self._begun - at)
        for window in seen:
            slopes, residual = _weighed(window, weights)
            total += slopes.T @ slopes
            pull += slopes.T @ residual
        scale = np.sqrt(np.diag(total))
        root = cholesky(total / np.outer(scale, scale))
        wanted = solve_triangular(root, pull / scale, trans="T")
        far = np.append(np.full(self._n, FARTHEST), np.full(self._problem.runs, np.inf))
        ends = np.maximum(self._low - at, -far) * scale, np.minimum(self._high - at, far) * scale
        found = lsq_linear(root, wanted, bounds=ends, tol=1e-12)
        inverse = np.linalg.inv(total / np.outer(scale, scale)) / np.outer(scale, scale)
        return inverse, np.asarray(found.x / scale)

    def _along(self, at: Floats, step: Floats, weights: Floats) -> Floats | None:
        """The place after the longest of ever shorter steps that is better; None where none is."""
        here = self._cost(at, weights)
        for k in range(HALVINGS):
            there = np.clip(at + 0.5**k * step, self._low, self._high)
            if self._cost(there, weights) < here:
                return there
        return None

    def _cost(self, at: Floats, weights: Floats) -> float:
        p = self._problem
        try:
            model = Model(placed(p.rig, p.wanted, at[: self._n]), p.period_s)
        except ValidationError:  # such a rig could not be followed
            return np.inf
        zeros = at[self._n :]

        def cost(window: Window) -> float:
            residual = residual_of(driven(model, window), window, zeros)
            return float(np.sum((residual / weights) ** 2))

        held = np.sum(((at - self._begun) / p.prior) ** 2)
        total = float(sum(in_threads(cost, p.windows, p.threads)) + held)
        return total if np.isfinite(total) else np.inf

    def _known(self, seen: Sequence[Seen], weights: Floats) -> Known:
        inverse, _ = self._step(self._begun, seen, weights)
        spectra, pulls, means = Spectra(), [], []
        for window in seen:
            slopes, residual = _weighed(window, weights)
            pulls.append(slopes.T @ residual)
            means.append(np.mean(window.residual / weights, axis=0))
            spectra.take(window.residual / weights)
        offset = np.sqrt(np.mean(np.square(means), axis=0)) / weights
        slopes = np.sum([np.sum(window.slopes, axis=0) for window in seen], axis=0)
        shared = offset[:, None] * slopes
        density = spectra.density()
        meat = sum(
            (coloured_meat(s.slopes / weights[:, None], density) for s in seen),
            np.zeros_like(inverse),
        )
        return combined(inverse, meat, pulls, list(shared))


def _weighed(window: Seen, weights: Floats) -> tuple[Floats, Floats]:
    slopes = (window.slopes / weights[:, None]).reshape(-1, window.slopes.shape[-1])
    return slopes, (window.residual / weights).ravel()
