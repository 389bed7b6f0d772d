"""Programs, gains and interlocks by hand, for tests that must not lean on the app's own expansion."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from rtcore.control.gains import GAINS
from rtcore.interlocks import INTERLOCKS, Action, Comparison, Quantity, armed_in
from rtcore.modes import Mode
from rtcore.program.segments import PROGRAM, TABLE, Branch, Segment

PERIOD_S = 250e-6
Row = dict[str, Any]

HOLD_ROW: Row = {"kind": Segment.HOLD}
END_ROW: Row = {"kind": Segment.END}


def fill(table: Any, rows: Iterable[Row]) -> None:
    """Write rows into a TABLE record; what a row leaves out stays as it is."""
    count = 0
    for count, row in enumerate(rows, start=1):
        record = table["segments"][count - 1]
        record["target"] = record["mean_from"] = np.nan
        for name, value in row.items():
            record[name] = value
    table["count"] = count


def table(*rows: Row) -> Any:
    """A TABLE record with an END behind the rows."""
    record = np.zeros(1, TABLE)[0]
    fill(record, [*rows, END_ROW])
    return record


def program(force: Iterable[Row], motion: Iterable[Row] = ()) -> Any:
    """A PROGRAM record."""
    record = np.zeros(1, PROGRAM)[0]
    fill(record["force"], [*force, END_ROW])
    fill(record["motion"], [*motion, END_ROW])
    return record


def harmonic(
    amplitude: float,
    frequency_hz: float,
    cycles: int,
    mean: float = 0.0,
    taper: int = 2,
    block: int = 0,
) -> list[Row]:
    """Taper in, whole cycles, taper out."""
    common = {
        "kind": Segment.HARMONIC,
        "block": block,
        "branch": Branch.WITH_NOTCH,
        "mean_to": mean,
        "frequency_from_hz": frequency_hz,
        "frequency_to_hz": frequency_hz,
    }
    ticks = round(taper / (frequency_hz * PERIOD_S))
    steady = round(cycles / (frequency_hz * PERIOD_S))
    return [
        {**common, "ticks": ticks, "amplitude_to": amplitude},
        {**common, "ticks": steady, "amplitude_to": amplitude, "continues": 1, "counts": 1},
        {**common, "ticks": ticks, "continues": 1},
    ]


def step(to: float, hold_s: float, block: int = 0) -> list[Row]:
    """A jump of the setpoint, held."""
    return [
        {"kind": Segment.SMOOTH, "target": to, "block": block},
        {"kind": Segment.HOLD, "ticks": round(hold_s / PERIOD_S), "block": block},
    ]


def gains() -> Any:
    """The gains of the sheet, with the compensator tuned at 4 Hz."""
    record = np.zeros(1, GAINS)[0]
    turn = 2.0 * np.pi
    for name, value in {
        "k_p": 1.19e-5,
        "k_i": 0.00438,
        "k_d": 3.39e-8,
        "omega_d_rad_s": 190.0 * turn,
        "k_ff": 6e-9,
        "valve_limit": 1.0,
        "valve_slew_per_s": np.inf,
        "ff_v": 1.9607,
        "ff_a": 0.010862,
        "lead_zero_rad_s": turn,
        "lead_pole_rad_s": 3.0 * turn,
        "low_pass_rad_s": 8.0 * turn,
        "low_pass_damping": 0.7,
        "low_pass_order": 1,
        "notch_damping": 0.15,
        "fade_s": 0.1,
        "compensate": 1,
    }.items():
        record[name] = value
    return record


PRESSURISED = armed_in(Mode.READY, Mode.RUNNING, Mode.HOLDING, Mode.STOPPING)


def detector(quantity: Quantity, threshold: float, action: Action, **other: Any) -> Row:
    """A detector that trips at once, armed whenever the loop is closed."""
    return {
        "quantity": quantity,
        "comparison": Comparison.MAGNITUDE_ABOVE,
        "action": action,
        "enabled": 1,
        "latching": 1,
        "armed_modes": PRESSURISED,
        "persistence_ticks": 1,
        "threshold": threshold,
    } | other


FORCE_LIMIT = detector(Quantity.FORCE_N, 55e3, Action.SHUTDOWN)
SILENCE = detector(Quantity.APP_SILENCE_S, 0.5, Action.STOP, comparison=Comparison.ABOVE)


def record_of(dtype: np.dtype[Any]) -> Any:
    """A record of zeros that kernels take, and that they can be read by where they are not compiled."""
    return np.zeros(1, np.dtype((np.record, dtype)))[0]


def interlocks(*detectors: Row) -> Any:
    """An INTERLOCKS record; the force limit alone where none is given."""
    record = record_of(INTERLOCKS)
    for i, row in enumerate(detectors or (FORCE_LIMIT,)):
        for name, value in row.items():
            record["detectors"][i][name] = value
    record["count"] = len(detectors or (FORCE_LIMIT,))
    return record
