"""Checks across the keys of one block; each raises an error that names the key it is about."""

import math

from app.definitions.limits import RIG
from app.documents.fields import wrong
from app.documents.units import say

ROUNDING = 1 + 1e-9  # what a limit may be exceeded by in computing


def exactly_one(first: str, a: object, second: str, b: object) -> None:
    """One of two keys, and not both."""
    if a is None and b is None:
        raise wrong(second, f"one of {first} and {second} is needed")
    if a is not None and b is not None:
        raise wrong(second, f"give {first} or {second}, not both", value=b)


def within(field: str, mean: float, amplitude: float, limit: float, unit: str) -> None:
    """Mean and amplitude together within a limit (N or m)."""
    peak = abs(mean) + amplitude
    if not peak <= limit:
        message = f"mean and amplitude reach {say(peak, unit)}, must be at most {say(limit, unit)}"
        raise wrong(field, message, value=peak, limit=limit, unit=unit)


def lasts(field: str, cycles: int | None, frequency_hz: float) -> None:
    """So many cycles within the longest duration."""
    duration_s = (cycles or 0) / frequency_hz
    if not duration_s <= RIG.duration_limit_s:
        limit = say(RIG.duration_limit_s, "s")
        message = f"{cycles:,} cycles last {say(duration_s, 's')}, must be at most {limit}"
        raise wrong(field, message, value=duration_s, limit=RIG.duration_limit_s, unit="s")


def slow_enough(field: str, amplitude_m: float, frequency_hz: float) -> None:
    """A harmonic motion within the velocity of the unit under test."""
    velocity_m_s = 2 * math.pi * frequency_hz * amplitude_m
    limit = RIG.velocity_limit_m_s
    if not velocity_m_s <= limit:
        message = (
            f"{say(amplitude_m, 'm')} at {say(frequency_hz, 'Hz')} reaches "
            f"{say(velocity_m_s, 'm/s')}, must be at most {say(limit, 'm/s')}"
        )
        raise wrong(field, message, value=velocity_m_s, limit=limit, unit="m/s")


def slow_enough_together(field: str, amplitude_m: float, steepest_per_s: float) -> None:
    """A course of an amplitude within the velocity of the unit; `steepest_per_s` is of the amplitude 1."""
    velocity_m_s, limit = amplitude_m * steepest_per_s, RIG.velocity_limit_m_s
    if not velocity_m_s <= limit:
        right = say(_below(limit / steepest_per_s), "m")
        message = (
            f"{say(amplitude_m, 'm')} of these frequencies reaches {say(velocity_m_s, 'm/s')}, "
            f"must be at most {say(limit, 'm/s')}: {right} would do"
        )
        raise wrong(field, message, value=velocity_m_s, limit=limit, unit="m/s")


def _below(value: float) -> float:
    """Three digits of a number > 0, rounded down."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return math.floor(value / digit) * digit
