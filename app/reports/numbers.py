"""Values as a report writes them: kN, mm, bar and degrees, and names as people say them."""

import math
from datetime import datetime

NOTHING = "—"
_SCALES = {  # the unit that a report uses, and how many of it one of ours is
    "N": ("kN", 1e-3),
    "N/s": ("kN/s", 1e-3),
    "m": ("mm", 1e3),
    "m/s": ("mm/s", 1e3),
    "Pa": ("bar", 1e-5),
    "m³/s": ("l/min", 6e4),
}
FINEST = 4  # places of what is in kN, mm or bar: less is noise
_ENDINGS = (
    "_octaves_s",
    "_n_s",
    "_m_s",
    "_rad_s",
    "_percent",
    "_deg",
    "_hz",
    "_pa",
    "_n",
    "_m",
    "_s",
)
_SHORT_S = ((1.0, 1.0, "s"), (1e-3, 1e3, "ms"), (0.0, 1e6, "µs"))


def unit_shown(unit: str) -> str:
    """The unit that a report writes values of this one in; nothing of a pure number."""
    shown = _SCALES.get(unit, (unit, 1.0))[0]
    return "" if shown in ("1", "-") else shown


def scale_of(unit: str) -> float:
    """What a value is multiplied by to be in the unit that is shown."""
    return _SCALES.get(unit, (unit, 1.0))[1]


def digits(value: float | None, places: int = 4) -> str:
    """So many significant digits, never in powers of ten where a reader can do without."""
    if value is None:
        return NOTHING
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else "infinite"
    if value == 0.0:
        return "0"
    before = math.floor(math.log10(abs(value))) + 1
    if before < -4:
        mantissa, power = f"{value:.{places - 1}e}".split("e")
        return _minus(f"{_short(mantissa)}e{power}")
    return _minus(_short(f"{value:,.{max(0, places - before)}f}"))


def quantity(value: float | None, unit: str) -> str:
    """A value with the unit that a report uses: 2,500 N is `2.5 kN`, 3.1e-4 s is `310 µs`."""
    if value is None:
        return NOTHING
    if unit == "s":
        return duration(value)
    shown = value * scale_of(unit)
    if unit in _SCALES and math.isfinite(shown):
        shown = round(shown, FINEST)
    return f"{digits(shown)} {unit_shown(unit)}".rstrip()


def duration(seconds: float | None) -> str:
    """`310 µs`, `41 ms`, `12.5 s`, `1 h 00 min 02 s`."""
    if seconds is None:
        return NOTHING
    if math.isfinite(seconds) and seconds >= 120.0:
        minutes, rest = divmod(round(seconds), 60)
        hours, minutes = divmod(minutes, 60)
        return (
            f"{hours} h {minutes:02d} min {rest:02d} s" if hours else f"{minutes} min {rest:02d} s"
        )
    if seconds == 0.0 or not math.isfinite(seconds):
        return f"{digits(seconds)} s"
    _, scale, unit = next(row for row in _SHORT_S if abs(seconds) >= row[0])
    return f"{digits(seconds * scale)} {unit}"


def spoken(name: str) -> str:
    """A name as people say it, without its unit: `force_error_rms_n` is `Force error rms`."""
    ending = next((e for e in _ENDINGS if name.endswith(e) and len(name) > len(e)), "")
    words = name.removesuffix(ending).replace("_", " ").strip()
    return words[:1].upper() + words[1:]


def moment(at: datetime | None) -> str:
    """`2026-11-22 14:05:09 UTC`."""
    return NOTHING if at is None else at.strftime("%Y-%m-%d %H:%M:%S UTC")


def _short(written: str) -> str:
    """Without zeros at the end that say nothing."""
    return written.rstrip("0").rstrip(".") if "." in written else written


def _minus(written: str) -> str:
    return written.replace("-", "−")
