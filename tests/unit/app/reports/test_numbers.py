"""How a report writes values."""

import math

import pytest

from app.reports.numbers import digits, duration, quantity, spoken


@pytest.mark.parametrize(
    ("value", "unit", "written"),
    [
        (2500.0, "N", "2.5 kN"),
        (-0.00207, "m", "−2.07 mm"),
        (21e6, "Pa", "210 bar"),
        (1e-9, "N", "0 kN"),
        (41e-3, "s", "41 ms"),
        (94.95, "%", "94.95 %"),
        (math.nan, "N", "not a number kN"),
        (None, "N", "—"),
    ],
)
def test_a_quantity_has_the_unit_of_the_report(
    value: float | None, unit: str, written: str
) -> None:
    assert quantity(value, unit) == written


@pytest.mark.parametrize(
    ("seconds", "written"),
    [
        (3e-6, "3 µs"),
        (0.0, "0 s"),
        (119.0, "119 s"),
        (125.4, "2 min 05 s"),
        (3602, "1 h 00 min 02 s"),
    ],
)
def test_durations_are_told_as_people_say_them(seconds: float, written: str) -> None:
    assert duration(seconds) == written


def test_digits_are_four_and_never_a_trailing_zero() -> None:
    assert [digits(v) for v in (123456.0, 12.3456, 0.5, 0.0, 1e-9)] == [
        *("123,456", "12.35", "0.5", "0", "1e−09")
    ]


@pytest.mark.parametrize(
    ("value", "written"),
    [
        (0.001234, "0.001234"),
        (0.0012345678, "0.001235"),
        (-1.2e-5, "−0.000012"),
        (1.23456e-5, "0.00001235"),
        (1.23456e-7, "1.235e−07"),
        (0.05678, "0.05678"),
        (0.99996, "1"),
    ],
)
def test_small_numbers_have_as_many_digits_as_large_ones(value: float, written: str) -> None:
    assert digits(value) == written


def test_names_lose_their_unit() -> None:
    assert spoken("force_error_rms_n") == "Force error rms"
    assert spoken("valve_saturation_share") == "Valve saturation share"
