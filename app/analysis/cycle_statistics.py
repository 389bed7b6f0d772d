"""Cycle statistics of each layer: how its peaks, valleys, means and ranges spread over its cycles."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.cycles import CycleReader
from app.analysis.evidence import Sine
from app.analysis.walk import Part

Layer = tuple[int, Sine | None]  # block and sine; of a sweep there is no one sine


@dataclass
class Spread:
    """Count, mean, standard deviation and extremes of values, chunk after chunk."""

    count: int = 0
    mean: float = 0.0
    low: float = np.inf
    high: float = -np.inf
    _squares: float = 0.0  # Σ (value − mean)²

    def take(self, values: npt.NDArray[np.float64]) -> None:
        """Count (n,) values (Chan, Golub and LeVeque 1979: no digits are lost in long runs)."""
        if len(values) == 0:
            return
        count, mean = len(values), float(np.mean(values))
        apart, total = mean - self.mean, self.count + count
        self._squares += float(np.sum((values - mean) ** 2))
        self._squares += apart * apart * self.count * count / total
        self.mean += apart * count / total
        self.count = total
        self.low = float(np.minimum(self.low, np.min(values)))
        self.high = float(np.maximum(self.high, np.max(values)))

    @property
    def deviation(self) -> float | None:
        """The standard deviation; None of less than two values."""
        return float(np.sqrt(self._squares / (self.count - 1))) if self.count > 1 else None


@dataclass
class LayerCycles:
    """The counted cycles of a layer; what is spread are those that nothing interrupted."""

    count: int = 0
    peak_n: Spread = field(default_factory=Spread)
    valley_n: Spread = field(default_factory=Spread)
    mean_n: Spread = field(default_factory=Spread)
    range_n: Spread = field(default_factory=Spread)

    def take(self, rows: npt.NDArray[Any]) -> None:
        """Count (n,) CYCLE."""
        self.count += len(rows)
        whole = rows[rows["whole"]]
        peaks_n, valleys_n = whole["peak_n"], whole["valley_n"]
        self.peak_n.take(peaks_n)
        self.valley_n.take(valleys_n)
        self.mean_n.take(0.5 * (peaks_n + valleys_n))
        self.range_n.take(peaks_n - valleys_n)


class CyclesByLayer:
    """Gathers the counted cycles of a run, part after part, by block and sine."""

    def __init__(self) -> None:
        self._reader = CycleReader()
        self._layers: dict[Layer, LayerCycles] = {}
        self._at: Layer | None = None

    def take(self, part: Part) -> None:
        """The next part of the run, of whatever kind."""
        if part.begins:
            self._file(self._reader.close())
            self._at = (part.stretch.block, part.stretch.sine) if part.stretch.counts else None
        self._file(self._reader.take(part))

    def close(self) -> None:
        """The run is over."""
        self._file(self._reader.close())

    def of(self, layer: Layer) -> LayerCycles | None:
        """The cycles of a layer, wherever in its block they come."""
        return self._layers.get(layer)

    def __iter__(self) -> Iterator[tuple[Layer, LayerCycles]]:
        return iter(self._layers.items())

    def _file(self, rows: npt.NDArray[Any]) -> None:
        if self._at is not None and len(rows):
            self._layers.setdefault(self._at, LayerCycles()).take(rows)
