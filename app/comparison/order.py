"""What is to be laid over each other, and what is while it is made."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from app.analysis.overlay import Band, Difference, Tolerance
from app.comparison.schemas import Align
from app.histories.history import Histories


@dataclass(frozen=True)
class Asked:
    """Which runs, and how they are to be compared."""

    ids: tuple[int, ...]
    channels: tuple[str, ...] = ("force_n",)
    align: Align = Align.TIME
    block: int | None = None
    from_s: float = 0.0
    to_s: float | None = None
    points: int = 2000
    tolerance_abs: float | None = None
    tolerance_rel: float | None = None

    @property
    def tolerance(self) -> Tolerance | None:
        """None where no tolerance was given."""
        if self.tolerance_abs is None and self.tolerance_rel is None:
            return None
        return Tolerance(self.tolerance_abs or 0.0, self.tolerance_rel or 0.0)


class Side(NamedTuple):
    """A run that is compared."""

    run_id: int
    folder: Path
    definition: Mapping[str, Any]
    period_s: float
    first_tick: int | None


@dataclass(frozen=True)
class Order:
    """What is to be laid over each other, and how; the first side is the baseline."""

    sides: tuple[Side, ...]
    channels: tuple[str, ...]
    align: Align
    block: int | None
    from_s: float
    to_s: float | None
    points: int
    tolerance: Tolerance | None
    histories: Histories | None = None


class Laid(NamedTuple):
    """Of a channel, place by place; one series and, but for the baseline, one difference a run."""

    series: list[Band]
    differences: list[Difference]
