"""The spectrum of a periodic excitation, period after period: means and what scatters about them.

One realisation of a multisine, in flat memory: of each excited line, and of those that were left out to
detect distortion, the mean over the periods and the covariance of the channels between them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.phasors import Complex


@dataclass(frozen=True)
class Realisation:
    """`mean` (channels, lines) amplitudes; `noise` (lines, channels, channels) covariance of one period.

    `lines` are numbers of cycles in a period. With one period nothing is known of the noise.
    """

    channels: tuple[str, ...]
    lines: npt.NDArray[np.int64]
    mean: Complex
    noise: Complex
    periods: int

    def of(self, channel: str) -> Complex:
        """(lines,) amplitudes of a channel."""
        return np.asarray(self.mean[self.channels.index(channel)])


class Periods:
    """Takes the ticks of a realisation, in which periods follow one another; gives what they amount to.

    A period in which ticks are missing, or within which the program was held, is left out, and so are the
    `settle` after it and the first `settle`.
    """

    def __init__(
        self, channels: Sequence[str], period_ticks: int, lines: Sequence[int], settle: int = 0
    ) -> None:
        self._channels = tuple(channels)
        self._lines = np.asarray(lines, np.int64)
        self._period = np.zeros((len(self._channels), period_ticks))
        self._settle = settle
        self._counts_from = settle  # the number of the first period that counts
        self._first: int | None = None
        self._next: tuple[int, int] | None = None  # position and tick that go on from the last
        self._filled = 0
        self._number = 0  # of the period that is being filled
        self._count = 0
        self._mean = np.zeros((len(self._lines), len(self._channels)), np.complex128)
        self._scatter = np.zeros((*self._mean.shape, len(self._channels)), np.complex128)

    def take(
        self, positions: npt.NDArray[np.int64], columns: Mapping[str, npt.NDArray[Any]]
    ) -> None:
        """The next ticks, (n,), with their positions in the program; held where their `tick` jumps."""
        if len(positions) == 0:
            return
        if self._first is None:
            self._first = int(positions[0])
        ticks = columns.get("tick", positions)
        breaks = (np.diff(positions) != 1) | (np.diff(ticks) != 1)
        edges = [0, *(np.flatnonzero(breaks) + 1).tolist(), len(positions)]
        for low, high in pairwise(edges):
            if self._next not in (None, (int(positions[low]), int(ticks[low]))):
                self._interrupt(int(positions[low]) - self._first)
            inner = {name: columns[name][low:high] for name in self._channels}
            self._follow(int(positions[low]) - self._first, high - low, inner)
            self._next = int(positions[high - 1]) + 1, int(ticks[high - 1]) + 1

    def realisation(self) -> Realisation | None:
        """What there is so far; None before the first whole period."""
        if self._count == 0:
            return None
        noise = self._scatter / max(1, self._count - 1)
        return Realisation(self._channels, self._lines, self._mean.T.copy(), noise, self._count)

    def _interrupt(self, at: int) -> None:
        """Something is missing before a tick, or the program was held there."""
        size = self._period.shape[1]
        begun = -(-at // size)  # the first period of which all is still to come
        self._counts_from, self._filled = begun + self._settle, 0

    def _follow(self, at: int, ticks: int, columns: Mapping[str, npt.NDArray[Any]]) -> None:
        """Ticks without a gap, the first so many after the realisation began."""
        size, done = self._period.shape[1], 0
        while done < ticks:
            self._number, within = divmod(at + done, size)
            more = min(ticks - done, size - within)
            for row, name in zip(self._period, self._channels, strict=True):
                row[within : within + more] = columns[name][done : done + more]
            self._filled = more if within == 0 else self._filled + more
            done += more
            if self._filled == size:
                self._add()

    def _add(self) -> None:
        """Count a period that is whole; Welford's sums."""
        self._filled = 0
        if self._number < self._counts_from:
            return
        size = self._period.shape[1]
        found = np.fft.rfft(self._period)[:, self._lines].T * (2 / size)
        self._count += 1
        before = found - self._mean
        self._mean += before / self._count
        after = found - self._mean
        self._scatter += before[:, :, None] * after[:, None, :].conj()
