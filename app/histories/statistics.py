"""What a time history comes to: its range, how steep its curve is, and how fast its content."""

from dataclasses import dataclass

import numpy as np

from app.histories.curve import Values, pieces, steepest

CONTENT = 0.999  # share of the AC power that lies within the bandwidth
_SEGMENT = 1 << 13  # of a spectrum
_STRETCH = 1 << 20  # samples whose spectrum is taken at once


@dataclass(frozen=True)
class Statistics:
    """Of samples in N or m. `steepest` is the change of the curve in one interval, `steepest_at`
    the index of the sample before it; `bandwidth` is in cycles a sample, 0 … 0.5."""

    samples: int
    low: float
    high: float
    first: float
    last: float
    steepest: float
    steepest_at: int
    bandwidth: float


def survey(values: Values) -> Statistics:
    """The statistics of (n,) samples, n ≥ 2, read piece by piece."""
    low, high, most, most_at = np.inf, -np.inf, 0.0, 0
    end, end_slope = np.zeros(0), np.zeros(0)
    for first, part, slope in pieces(values):
        low, high = min(low, part.min()), max(high, part.max())
        joined = np.concatenate([end, part]), np.concatenate([end_slope, slope])
        rates = steepest(*joined)
        at = int(np.argmax(rates)) if len(rates) else 0
        if len(rates) and rates[at] > most:
            most, most_at = float(rates[at]), first - len(end) + at
        end, end_slope = part[-1:], slope[-1:]
    return Statistics(
        samples=len(values),
        low=float(low),
        high=float(high),
        first=float(values[0]),
        last=float(values[-1]),
        steepest=most,
        steepest_at=most_at,
        bandwidth=bandwidth(values),
    )


def bandwidth(values: Values) -> float:
    """The frequency below which 99.9 % of the AC power lies, in cycles a sample, by Welch."""
    from scipy.signal import welch  # a second to load, and few ask

    segment = min(_SEGMENT, len(values))
    total = np.zeros(segment // 2 + 1)
    frequencies = np.zeros(segment // 2 + 1)
    for first in range(0, len(values), _STRETCH):
        first = max(0, min(first, len(values) - segment))
        part = np.asarray(values[first : first + _STRETCH], np.float64)
        frequencies, power = welch(part, nperseg=segment, detrend="constant")
        total += power * len(part)
    total[0] = 0.0
    whole = total.sum()
    if not whole > 0:
        return 0.0
    reached = np.searchsorted(np.cumsum(total), CONTENT * whole)
    return float(frequencies[min(reached, len(frequencies) - 1)])
