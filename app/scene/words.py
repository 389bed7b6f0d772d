"""What the labels in the scene say, in the units of the console's pages: people read them."""

UNKNOWN = "–"


def force(force_n: float | None) -> str:
    """In kN."""
    return f"{_figure(force_n, 1e-3, 2)} kN"


def pressure(pressure_pa: float | None) -> str:
    """In bar."""
    return f"{_figure(pressure_pa, 1e-5, 0)} bar"


def length(length_m: float | None) -> str:
    """In mm."""
    return f"{_figure(length_m, 1e3, 2)} mm"


def share(value: float | None) -> str:
    """In per cent."""
    return f"{_figure(value, 100.0, 0)} %"


def _figure(value: float | None, scale: float, places: int) -> str:
    if value is None or value != value:
        return UNKNOWN
    figure = f"{value * scale:,.{places}f}".replace("-", "−")
    return figure.removeprefix("−") if not figure.strip("−0.,") else figure
