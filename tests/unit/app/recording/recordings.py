"""Recordings made for tests: ticks with gaps, values with NaN and infinity, in parts or in a file."""

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from app.recording.files import convert
from app.recording.outcome import UNKNOWN
from app.recording.run_file import Recorded, RunFile
from rtcore.channels import TELEMETRY

Records = npt.NDArray[Any]
CHANNELS = ["force_n", "mode", "trips"]


def records_of(ticks: npt.NDArray[np.int64], seed: int) -> Records:
    """Noise, in places not a number or infinite."""
    random = np.random.default_rng(seed)
    records = np.zeros(len(ticks), TELEMETRY)
    records["tick"], records["time_s"] = ticks, ticks * 250e-6
    records["force_n"] = random.normal(size=len(ticks))
    records["force_n"][random.random(len(ticks)) < 0.1] = np.nan
    records["force_n"][random.random(len(ticks)) < 0.001] = -np.inf
    records["mode"] = random.integers(-3, 4, len(ticks))
    records["trips"] = random.integers(0, 1 << 60, len(ticks)).astype(np.uint64) << np.uint64(4)
    return records


def ticks_with_gaps(first: int, stretches: list[tuple[int, int]]) -> npt.NDArray[np.int64]:
    """(recorded, missing) one after the other."""
    ticks, at = [], first
    for recorded, missing in stretches:
        ticks.append(np.arange(at, at + recorded))
        at += recorded + missing
    return np.concatenate(ticks)


def record(runs_dir: Path, records: Records, batch: int = 400) -> RunFile:
    """Recorded so many ticks at a time, as run 1, not ended."""
    file = RunFile.open(1, runs_dir, int(records["tick"][0]))
    for start in range(0, len(records), batch):
        file.append(records[start : start + batch])
    return file


def recorded_of(file: RunFile) -> Recorded:
    """All there is in a file."""
    return Recorded(file.began_at, file.next_tick - 1, file.extent.ticks, file.missing_ticks)


def end(file: RunFile) -> Recorded:
    """The run is over: its parts become a file."""
    file.abandon_part()
    return convert(file.folder, {"run_id": file.run_id}, recorded_of(file), UNKNOWN)


def least_and_greatest(values: npt.NDArray[Any]) -> tuple[float, float]:
    """The plain definition: NaN does not count, and nothing but NaN gives NaN."""
    numbers = [float(value) for value in values.tolist() if value == value]
    return (min(numbers), max(numbers)) if numbers else (np.nan, np.nan)
