"""Amplitude and phase of a harmonic in samples of any length, by least squares."""

import numpy as np
import numpy.typing as npt

HARMONICS = 5  # fitted beside the fundamental's own, so that none of them leaks into it


def fundamental(samples: npt.NDArray[np.floating], frequency_hz: float, period_s: float) -> complex:
    """The fundamental of (n,) samples: its amplitude, and its phase against e^(jωt) from sample 0.

    Mean and higher harmonics below half the sampling rate are fitted with it. Raises ValueError where
    the samples cover less than two cycles.
    """
    n = len(samples)
    if n * period_s * frequency_hz < 2.0:
        raise ValueError(f"{n} samples are less than two cycles of {frequency_hz} Hz")
    turns = 2.0 * np.pi * frequency_hz * period_s * np.arange(n)
    orders = [k for k in range(1, HARMONICS + 1) if k * frequency_hz < 0.45 / period_s]
    columns = [np.ones(n)]
    for k in orders:
        columns += [np.cos(k * turns), np.sin(k * turns)]
    values = np.asarray(samples, np.float64)
    found = np.linalg.lstsq(np.stack(columns, 1), values, rcond=None)[0]
    return complex(found[1], -found[2])


def decibels(ratio: complex) -> float:
    """20 log10 |ratio|."""
    return float(20.0 * np.log10(abs(ratio)))
