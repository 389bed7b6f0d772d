"""Minimum and maximum over equal stretches of ticks: what a chart needs, never a stride."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.recording.samples import Columns

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Envelope:
    """(n_bins,) first tick of each bin, and (n_bins,) least and greatest value a channel.

    A bin without any tick is left out. NaN stands where every value of the bin is NaN.
    """

    ticks: npt.NDArray[np.int64]
    low: dict[str, Floats]
    high: dict[str, Floats]
    bin_ticks: int


def envelope(
    chunks: Iterable[Columns], names: Sequence[str], first_tick: int, last_tick: int, points: int
) -> Envelope:
    """At most `points` bins of equal width from `first_tick` to `last_tick`, both included."""
    width = max(1, -(-(last_tick - first_tick + 1) // points))
    bins = max(0, (last_tick - first_tick) // width + 1)
    seen = np.zeros(bins, dtype=np.bool_)
    low = {name: np.full(bins, np.nan) for name in names}
    high = {name: np.full(bins, np.nan) for name in names}
    for columns in chunks:
        places = (columns["tick"] - first_tick) // width
        if len(places) == 0:
            continue
        starts = np.flatnonzero(np.diff(places, prepend=places[0] - 1))
        at = places[starts]
        seen[at] = True
        for name in names:
            values = columns[name].astype(np.float64)
            low[name][at] = np.fmin(low[name][at], np.fmin.reduceat(values, starts))
            high[name][at] = np.fmax(high[name][at], np.fmax.reduceat(values, starts))
    return Envelope(
        ticks=first_tick + width * np.flatnonzero(seen),
        low={name: values[seen] for name, values in low.items()},
        high={name: values[seen] for name, values in high.items()},
        bin_ticks=width,
    )
