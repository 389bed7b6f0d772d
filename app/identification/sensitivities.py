"""What each parameter does to each window: the model simulated once as it is, and once with each parameter moved."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
import numpy.typing as npt
from pydantic import ValidationError

from app.identification.model import FORCE, MEASURED, Model
from app.identification.parameters import Parameter, placed
from app.identification.windows import RUN_UP, Window
from rtcore.rig.parameters import RigParameters

Floats = npt.NDArray[np.float64]
STEP = 1e-3  # of a coordinate: far above what rounding leaves, far below what bends the model

T = TypeVar("T")


@dataclass(frozen=True)
class Seen:
    """Of a window: `residual` (n, 7), measured less modelled, and `slopes` (n, 7, p) of the model."""

    residual: Floats
    slopes: Floats


class Sensitivities:
    """Models about one place of the search; the runs' force zeros are the last of its parameters."""

    def __init__(
        self,
        rig: RigParameters,
        wanted: Sequence[Parameter],
        at: Floats,
        zeros_n: Floats,
        period_s: float,
        free: npt.NDArray[np.bool_] | None = None,
    ) -> None:
        """`free` (p,) is which coordinates matter; the slopes of the others are left at nothing."""
        self._zeros_n = zeros_n
        self._count = len(wanted)
        self._centre = Model(placed(rig, wanted, at), period_s)
        places = [i for i in range(len(wanted)) if free is None or free[i]]
        self._moved = {i: _beside(rig, wanted, at, i, period_s) for i in places}

    def seen(self, window: Window) -> Seen:
        """The residual of a window and what moves it."""
        found = driven(self._centre, window)
        slopes = np.zeros((*found.shape, self._count + len(self._zeros_n)))
        for i, (model, step) in self._moved.items():
            slopes[:, :, i] = (driven(model, window) - found) / step
        slopes[:, FORCE, self._count + window.source] = 1.0
        return Seen(residual_of(found, window, self._zeros_n), slopes)


def _beside(
    rig: RigParameters, wanted: Sequence[Parameter], at: Floats, i: int, period_s: float
) -> tuple[Model, float]:
    """The model with one coordinate moved, and by how much: the other way where such a rig could not be followed."""
    for step in (STEP, -STEP):
        there = at.copy()
        there[i] += step
        with suppress(ValidationError):
            return Model(placed(rig, wanted, there), period_s), step
    raise ValueError(f"{wanted[i].path} cannot be moved either way")


def driven(model: Model, window: Window) -> Floats:
    """(n, 7) what the model makes of a window."""
    return model.driven(window.start, window.driving)[RUN_UP:]


def residual_of(found: Floats, window: Window, zeros_n: Floats) -> Floats:
    """(n, 7) measured less modelled, each run with a force zero of its own."""
    residual = window.measured - found
    residual[:, FORCE] -= zeros_n[window.source]
    return residual


def root_mean_square(residuals: Iterable[Floats]) -> Floats:
    """(7,) over all windows."""
    total, count = np.zeros(len(MEASURED)), 0
    for residual in residuals:
        total += np.sum(residual**2, axis=0)
        count += len(residual)
    return np.asarray(np.sqrt(total / max(count, 1)))


def in_threads(work: Callable[[Window], T], windows: Sequence[Window], threads: int) -> Iterator[T]:
    """The work on each window, in order: the kernels let other threads run meanwhile."""
    if threads <= 1:
        yield from map(work, windows)
        return
    with ThreadPoolExecutor(threads, "identification") as pool:
        yield from pool.map(work, windows)
