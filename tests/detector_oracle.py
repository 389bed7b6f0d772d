"""What detectors must do, written down once more without the loop's code: the tests' independent truth."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

PERIOD_S = 250e-6
VALUE, RATE, LOOK_AHEAD = range(3)
MAGNITUDE_ABOVE, ABOVE, BELOW, OUTSIDE = range(4)
NOTHING, INDICATE, HOLD, STOP, SHUTDOWN = range(-1, 4)
Row = Mapping[str, Any]


def compared(row: Row, values: Sequence[float], rate_before: float) -> tuple[float, float]:
    """The value that a detector compares, and its smoothed rate, of the last two values of its quantity."""
    before, now = values
    rate = (now - before) / PERIOD_S
    rate = rate if math.isfinite(rate) else 0.0
    smoothing_s = max(row.get("smoothing_s", 0.0), PERIOD_S)
    rate = rate_before + PERIOD_S / smoothing_s * (rate - rate_before)
    if not math.isfinite(now) or row["form"] == VALUE:
        return now, rate
    return (rate, rate) if row["form"] == RATE else (now + row["horizon_s"] * rate, rate)


def violates(row: Row, value: float) -> bool:
    """Whether a value is beyond the row's limits; what is no number always is."""
    if math.isnan(value):
        return True
    match row["comparison"]:
        case 0:
            return bool(abs(value) > row["threshold"])
        case 1:
            return bool(value > row["threshold"])
        case 2:
            return bool(value < row["threshold"])
    return bool(value < row["low"] or value > row["threshold"])


@dataclass
class Oracle:
    """A table of detectors, followed tick by tick from the quantities alone."""

    rows: Sequence[Row]
    trips: int = 0
    first_out: int = -1
    counts: list[int] = field(default_factory=list)
    rates: list[float] = field(default_factory=list)
    last: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.counts = [0] * len(self.rows)
        self.rates = [0.0] * len(self.rows)
        self.last = [math.nan] * len(self.rows)

    def see(self, quantities: Sequence[float], mode: int) -> int:
        """One tick, begun in `mode`. Returns the strongest action that is called for."""
        strongest, first = NOTHING, -1
        for i, row in enumerate(self.rows):
            now = quantities[row["quantity"]]
            value, self.rates[i] = compared(row, (self.last[i], now), self.rates[i])
            self.last[i] = now
            armed = bool(row["enabled"]) and bool(row["armed_modes"] >> mode & 1)
            self.counts[i] = self.counts[i] + 1 if armed and violates(row, value) else 0
            if self.counts[i] >= row["persistence_ticks"]:
                self.trips |= 1 << i
                if row["action"] > strongest:
                    strongest, first = row["action"], i
            elif self.counts[i] == 0 and row["action"] < STOP and not row["latching"]:
                self.trips &= ~(1 << i)
        if strongest >= STOP and self.first_out < 0:
            self.first_out = first
        return strongest

    def reset(self) -> None:
        """The loop has accepted a reset."""
        self.trips, self.first_out = 0, -1
