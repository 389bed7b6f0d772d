"""One point of a frequency response, with how far it can be trusted."""

from typing import NamedTuple


class Interval(NamedTuple):
    """In which the truth lies in 95 of 100 cases."""

    low: float
    high: float


class ResponsePoint(NamedTuple):
    """A transfer at one frequency, amplitude and mean.

    `asked_n` is the amplitude of the series that it was measured for, where it may have been backed off.
    `gain` is in the transfer's unit, `phase_deg` negative where the output lags. `coherence` is 0…1: the
    share of the output that the input explains, cycle by cycle; None where nothing is known of the noise. An
    interval of less than two cycles has no bounds: its end is inf, its phase a whole turn.
    `distortion_percent` is the output's harmonics in % of its fundamental, None where no harmonic is below
    half the loop rate or there is no fundamental.
    """

    transfer: str
    block: int
    frequency_hz: float
    amplitude_n: float
    mean_n: float
    gain: float
    phase_deg: float
    gain_95: Interval
    phase_95_deg: Interval
    coherence: float | None
    distortion_percent: float | None
    cycles: int
    settled: bool
    asked_n: float | None = None
