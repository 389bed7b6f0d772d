"""Units by the last words of a name, and values as an operator reads them."""

import math

_UNITS = (  # the longest ending first
    ("_n_s", "N/s"),
    ("_m_s", "m/s"),
    ("_octaves_s", "octaves/s"),
    ("_per_s", "1/s"),
    ("_rad_s", "rad/s"),
    ("_percent", "%"),
    ("_deg", "°"),
    ("_hz", "Hz"),
    ("_pa", "Pa"),
    ("_n", "N"),
    ("_m", "m"),
    ("_s", "s"),
)


def unit_of(name: str) -> str | None:
    """The unit that a name ends in (`rate_n_s` → N/s), or None for a pure number."""
    return next((unit for ending, unit in _UNITS if name.endswith(ending)), None)


def say(value: object, unit: str | None = None) -> str:
    """A value with its unit: `60,000 N`, `0.5 s`, `not a number`, `'fast'`."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return f"'{value}'" if isinstance(value, str) else str(value)
    number = _whole(value) if isinstance(value, int) else _digits(value)
    return f"{number} {unit}" if unit else number


def _whole(value: int) -> str:
    # Python writes no whole number of thousands of digits, and nobody would read it.
    return f"{value:,}" if abs(value) < 10**30 else "a number too large"


def _digits(value: float) -> str:
    if math.isnan(value):
        return "not a number"
    return f"{value:,.0f}" if 1e6 <= abs(value) < 1e15 else f"{value:,.6g}"
