"""What an acquisition gives: rows of named columns, chunk after chunk of the run."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from app.analysis.walk import Columns
from rtcore.channels import CHANNEL

Rows = dict[str, npt.NDArray[Any]]


class Column(NamedTuple):
    """A column of a table; `dtype` as numpy has it."""

    name: str
    unit: str
    dtype: str


class Acquisition(Protocol):
    """Takes a run chunk by chunk and gives the rows that are complete; memory stays flat."""

    @property
    def columns(self) -> Sequence[Column]:
        """The columns of its rows."""

    @property
    def needs(self) -> Sequence[str]:
        """The channels that each chunk must have."""

    def take(self, chunk: Columns) -> Rows:
        """The rows that are complete with the next ticks of the run, in order."""

    def close(self) -> Rows:
        """The rows that the end of the run completes."""


def measured_channels(names: Iterable[str]) -> tuple[str, ...]:
    """Those channels of `names` that are physical quantities, not counters or clocks."""
    clocks = ("wakeup_latency_s", "tick_time_s")
    return tuple(n for n in names if CHANNEL[n].dtype == "f4" and n not in clocks)


def channel_columns(names: Iterable[str], prefix: str = "") -> list[Column]:
    """Columns for channels, `max_` or the like before their names."""
    return [Column(prefix + name, CHANNEL[name].unit, "f4") for name in names]


def empty(columns: Iterable[Column]) -> Rows:
    """No rows."""
    return {column.name: np.zeros(0, column.dtype) for column in columns}


def joined(pieces: Sequence[Mapping[str, npt.NDArray[Any]]], columns: Sequence[Column]) -> Rows:
    """Rows after one another, each column of its type."""
    if not pieces:
        return empty(columns)
    return {
        c.name: np.concatenate([piece[c.name] for piece in pieces]).astype(c.dtype, copy=False)
        for c in columns
    }
