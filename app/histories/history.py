"""A time history as definitions hold it: known by its content, its samples where they lie."""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np

from app.histories.curve import Values
from app.histories.statistics import Statistics, survey


@dataclass(frozen=True)
class History:
    """Evenly spaced samples in SI. `unit` is N or m where the file says so.

    Two histories are equal where their content is; samples in a file stay there until read.
    """

    sha256: str
    rate_hz: float
    unit: str | None
    statistics: Statistics
    samples: Values | Path = field(compare=False, repr=False)

    @property
    def values(self) -> Values:
        """(n,) float64, mapped from the file where there is one."""
        if isinstance(self.samples, Path):
            mapped: Values = np.load(self.samples, mmap_mode="r")
            return mapped
        return self.samples

    @property
    def bandwidth_hz(self) -> float:
        """Where 99.9 % of the AC power lies below."""
        return self.statistics.bandwidth * self.rate_hz


class Histories(Protocol):
    """Where definitions find the files of their time histories."""

    def find(self, name: str, rate_hz: float | None) -> History | str:
        """The history of a name, or a sentence why there is none.

        `rate_hz` is what the test says, for files that do not say it themselves.
        """


def from_values(values: Values, rate_hz: float) -> History:
    """A history of samples in memory, (n,), n ≥ 2."""
    digest = hashlib.sha256(np.ascontiguousarray(values, "<f8").tobytes()).hexdigest()
    return History(digest, rate_hz, None, survey(values), values)
