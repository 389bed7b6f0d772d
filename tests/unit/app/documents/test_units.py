"""Units come from names, and values read as an operator reads them."""

import pytest

from app.documents.units import say, unit_of


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("rate_n_s", "N/s"),
        ("rate_m_s", "m/s"),
        ("amplitude_n", "N"),
        ("amplitude_m", "m"),
        ("frequency_hz", "Hz"),
        ("duration_s", "s"),
        ("phase_deg", "°"),
        ("cycles", None),
        ("times", None),
    ],
)
def test_the_last_words_of_a_name_are_its_unit(name: str, unit: str | None) -> None:
    assert unit_of(name) == unit


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (60000, "N", "60,000 N"),
        (60000.0, "N", "60,000 N"),
        (0.5, "s", "0.5 s"),
        (7696902.4, "N/s", "7,696,902 N/s"),
        (float("nan"), None, "not a number"),
        (float("inf"), "N", "inf N"),
        ("fast", "m/s", "'fast'"),
        (True, None, "True"),
        (10**400, None, "a number too large"),
    ],
)
def test_values_are_said_with_their_unit(value: object, unit: str | None, text: str) -> None:
    assert say(value, unit) == text
