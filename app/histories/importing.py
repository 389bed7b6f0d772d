"""From the text of a CSV file to a folder with even samples and what they come to."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.lib import format as npy
from pydantic import BaseModel, ConfigDict

from app.histories.columns import decoded, line_of, read_columns
from app.histories.curve import CHUNK, Values
from app.histories.even import count_at, rate_of, resampled
from app.histories.history import History
from app.histories.layout import Layout, Unreadable, layout_of
from app.histories.statistics import Statistics, bandwidth, survey

SAMPLES, ABOUT = "samples.npy", "history.json"
_HEAD_BYTES = 1 << 16


class HistoryInfo(BaseModel):
    """A time history in the store. `unit` is N or m where the file's heading says so."""

    model_config = ConfigDict(frozen=True)

    file: str
    sha256: str
    column: str
    unit: str | None
    samples: int
    rate_hz: float
    resampled: bool
    duration_s: float
    min: float
    max: float
    bandwidth_hz: float


class About(HistoryInfo):
    """What is kept beside the samples."""

    statistics: Statistics


def convert(
    source: Path, folder: Path, name: str, sha256: str, column: str | None, rate_hz: float | None
) -> About:
    """Read a CSV file and write its samples into a folder. Raises `Unreadable`."""
    layout = _layout(source, column, rate_hz)
    times, values = _raw(source, folder, layout)
    if len(values) < 2:
        raise Unreadable("a time history needs two samples at least", layout.first_line)
    own_hz, even = _rate(times, rate_hz, source, layout)
    wanted_hz = rate_hz or own_hz
    again = times is not None and not (even and abs(wanted_hz - own_hz) <= 1e-6 * own_hz)
    path = folder / SAMPLES
    if again and times is not None:
        parts = resampled(times, values, wanted_hz)
        samples = _written(path, count_at(times, wanted_hz), parts)
    else:
        samples = _written(path, len(values), _chunks(values))
    found = survey(samples)
    about = About(
        file=name,
        sha256=sha256,
        column=layout.heading,
        unit=layout.unit,
        samples=found.samples,
        rate_hz=wanted_hz,
        resampled=again,
        duration_s=(found.samples - 1) / wanted_hz,
        min=found.low,
        max=found.high,
        # Of the samples as they came: resampling to a lower rate must not hide what is fast.
        bandwidth_hz=max(found.bandwidth * wanted_hz, bandwidth(values) * own_hz),
        statistics=found,
    )
    (folder / ABOUT).write_text(about.model_dump_json(indent=2), encoding="utf-8")
    return about


def opened(folder: Path, about: About) -> History:
    """The history of a folder."""
    statistics = replace(about.statistics, bandwidth=about.bandwidth_hz / about.rate_hz)
    return History(about.sha256, about.rate_hz, about.unit, statistics, folder / SAMPLES)


def _layout(source: Path, column: str | None, rate_hz: float | None) -> Layout:
    with source.open("rb") as file:
        head = file.read(_HEAD_BYTES)
        head += file.readline()
    return layout_of(decoded(head).splitlines(), column, rate_hz is not None)


def _raw(source: Path, folder: Path, layout: Layout) -> tuple[Values | None, Values]:
    """The columns as they stand in the file, on disk."""
    times, values = folder / "times.raw", folder / "values.raw"
    with times.open("wb") as time_file, values.open("wb") as value_file:
        for time_part, value_part in read_columns(source, layout):
            value_file.write(np.ascontiguousarray(value_part, "<f8").data)
            if time_part is not None:
                time_file.write(np.ascontiguousarray(time_part, "<f8").data)
    return (None if layout.time is None else _mapped(times)), _mapped(values)


def _mapped(path: Path) -> Values:
    if path.stat().st_size == 0:
        return np.zeros(0)
    return np.memmap(path, "<f8", "r")


def _rate(
    times: Values | None, rate_hz: float | None, source: Path, layout: Layout
) -> tuple[float, bool]:
    if times is not None:
        return rate_of(times, lambda index: line_of(source, layout, index))
    if rate_hz is None:
        raise Unreadable("the file has no column of times: say its rate_hz")
    return rate_hz, True


def _written(path: Path, count: int, parts: Iterable[Values]) -> Values:
    """So many samples, part after part, as an .npy file, which is mapped. Raises `OSError`.

    They are written and not mapped: where a mapped file finds no room, the process is ended by a signal.
    """
    head = {"descr": "<f8", "fortran_order": False, "shape": (count,)}
    with path.open("wb") as file:
        npy.write_array_header_1_0(file, head)
        for part in parts:
            file.write(np.ascontiguousarray(part, "<f8").data)
    samples: Values = np.load(path, mmap_mode="r")
    return samples


def _chunks(values: Values) -> Iterator[Values]:
    return (values[i : i + CHUNK] for i in range(0, len(values), CHUNK))
