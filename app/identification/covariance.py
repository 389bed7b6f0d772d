"""How well parameters are known: the covariance of a fit whose residuals are coloured.

If residuals were white, the inverse of the information would be all. They are not: quantisers repeat themselves, and
what the model lacks comes back. So each of three estimates is made, and of each parameter the widest counts:
the residuals' own spectra carried through the fit (Klein and Morelli), the scatter of what single windows want
(the sandwich with windows as clusters), and the white one as a floor. What windows' means are off by comes on top,
as if all windows shared it: their scatter cannot tell what they share.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.stats import t as student

Floats = npt.NDArray[np.float64]
SMOOTHED = 9  # lines of the residuals' spectra that are averaged
CONFIDENCE = 0.95
HINT = 1e-6


@dataclass(frozen=True)
class Known:
    """`covariance` (p, p) of the coordinates, and by how many deviations an interval reaches to either side."""

    covariance: Floats
    reach: float

    @property
    def deviation(self) -> Floats:
        """(p,)."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    @property
    def correlation(self) -> Floats:
        """(p, p)."""
        return np.asarray(self.covariance / np.outer(self.deviation, self.deviation))


class Spectra:
    """Cross spectra of weighed residuals, gathered window by window."""

    def __init__(self) -> None:
        self._sum: npt.NDArray[np.complex128] | None = None
        self._count = 0

    def take(self, residual: Floats) -> None:
        """(n, c) weighed."""
        lines = np.fft.rfft(residual, axis=0)
        cross = lines.conj()[:, :, None] * lines[:, None, :] / len(residual)
        self._sum = cross if self._sum is None else self._sum + cross
        self._count += 1

    def density(self) -> npt.NDArray[np.complex128]:
        """(lines, c, c), averaged over windows and neighbouring lines."""
        assert self._sum is not None, "no window was taken"
        mean = self._sum / self._count
        reach = SMOOTHED // 2
        padded = np.pad(mean, ((reach, reach), (0, 0), (0, 0)), mode="reflect")
        return np.asarray(np.mean([padded[i : i + len(mean)] for i in range(SMOOTHED)], axis=0))


def coloured_meat(slopes: Floats, density: npt.NDArray[np.complex128]) -> Floats:
    """(p, p) Jᵀ R J of a window with (n, c, p) weighed slopes, R being what has this spectral density."""
    n = len(slopes)
    lines = np.fft.rfft(slopes, axis=0)
    twice = np.full(len(lines), 2.0)
    twice[0] = 1.0
    if n % 2 == 0:
        twice[-1] = 1.0
    through = density @ lines
    return np.asarray(
        np.einsum("f,fcp,fcq->pq", twice, lines.conj(), through, optimize=True).real / n
    )


def combined(
    inverse: Floats, meat: Floats, pulls: Sequence[Floats], shared: Sequence[Floats]
) -> Known:
    """From the inverse information (p, p), the coloured meat (p, p), each window's pull Jᵀr (p,), and what each
    channel would pull, (p,), if all windows were off by the same."""
    coloured = inverse @ meat @ inverse
    moved = np.stack([inverse @ pull for pull in pulls])
    scattered = np.sum(moved**2, axis=0) * len(pulls) / max(len(pulls) - 1, 1)
    common = np.sum([(inverse @ pull) ** 2 for pull in shared], axis=0)
    variance = np.maximum(np.maximum(np.diag(coloured), scattered), np.diag(inverse)) + common
    mixed = coloured + HINT * inverse  # of what no residual moves there is no colour
    shape = mixed / np.sqrt(np.outer(np.diag(mixed), np.diag(mixed)))
    deviation = np.sqrt(variance)
    reach = float(student.ppf(0.5 + 0.5 * CONFIDENCE, max(len(pulls) - 1, 1)))
    return Known(shape * np.outer(deviation, deviation), reach)
