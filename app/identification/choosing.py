"""Which windows are worth their time: those that together tell most of the parameters."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


def information(slopes: Floats, deviations: Floats) -> Floats:
    """(p, p) Fisher's information of a window with (n, 7, p) slopes, if its residuals were white."""
    weighed = (slopes / deviations[:, None]).reshape(-1, slopes.shape[-1])
    return np.asarray(weighed.T @ weighed)


def most_telling(informations: Sequence[Floats], prior: Floats, count: int) -> list[int]:
    """Which windows to take, in order: each time the one after which the parameters are known best together.

    That is the greatest determinant of the information, `prior` (p, p) being there before any of them.
    """
    chosen: list[int] = []
    total = prior.copy()
    left = set(range(len(informations)))
    while left and len(chosen) < count:
        best = max(sorted(left), key=lambda i: _log_volume(total + informations[i]))
        total = total + informations[best]
        chosen.append(best)
        left.remove(best)
    return sorted(chosen)


def _log_volume(total: Floats) -> float:
    scale = np.sqrt(np.diag(total))
    return float(np.linalg.slogdet(total / np.outer(scale, scale))[1] + 2.0 * np.log(scale).sum())
