"""An hour's recording without the hour: the very tick on the virtual clock, through the recorder's own files."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
import pyarrow.parquet as pq

from app.recording.files import convert, parquet_path
from app.recording.outcome import UNKNOWN
from app.recording.run_file import Recorded, RunFile
from app.recording.samples import open_samples
from app.runs.envelope import envelope
from bench.recorded import begin, make_test, virtual_rig
from bench.report import tracked
from rtcore.rig.parameters import load_rig
from rtcore.virtual import PERIOD_S

DRAIN_TICKS = 400
SECOND_TICKS = round(1 / PERIOD_S)
WINDOW_TICKS = 5 * SECOND_TICKS
CHANNEL = "force_n"
REPEATS = 9


@dataclass
class Long:
    """What was measured on it; times in seconds, medians."""

    ticks: int = 0
    append_s_per_tick: float = 0.0
    part_bytes: int = 0
    file_bytes: int = 0
    overview_bytes: int = 0
    convert_s_per_tick: float = 0.0
    under_way: dict[str, float] = field(default_factory=dict)
    over: dict[str, float] = field(default_factory=dict)
    plain_read_s: float = 0.0


def measure(duration_s: float) -> Long:
    """Record so long, read it, make its file, read that."""
    with TemporaryDirectory(prefix="forcerig-bench-") as name:
        found = Long()
        file = _recorded(Path(name), duration_s, found)
        found.under_way = _readings(file.folder)
        file.abandon_part()
        _converted(file, found)
        found.over = _readings(file.folder)
        path = parquet_path(file.folder)
        found.plain_read_s = _time(lambda: pq.read_table(path, columns=[CHANNEL]))
        return found


def _recorded(runs_dir: Path, duration_s: float, found: Long) -> RunFile:
    records = _seconds(duration_s)
    first = next(records)
    file = RunFile.open(1, runs_dir, int(first["tick"][0]))
    spent_s = _appended(file, first)
    for more in records:
        spent_s += _appended(file, more)
    found.ticks = file.extent.ticks
    found.append_s_per_tick = spent_s / found.ticks
    found.part_bytes = sum(path.stat().st_size for path in file.folder.glob("part-*"))
    return file


def _seconds(duration_s: float) -> Iterator[np.ndarray]:
    """The telemetry of a test, a second at a time; times of wake-ups and ticks as if it were the loop."""
    virtual = virtual_rig(load_rig())
    virtual.bring_to_ready()
    blocks = [{"kind": "harmonic", "mean_n": 0, "amplitude_n": 2000, "frequency_hz": 5}]
    motion = [{"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4}]
    whole = {"duration_s": duration_s + 1.0}
    begin(virtual, make_test([blocks[0] | whole], [motion[0] | whole]))
    random = np.random.default_rng(1)
    for _ in tracked(range(round(duration_s)), "recording on the virtual clock"):
        records = virtual.advance(SECOND_TICKS)
        records["wakeup_latency_s"] = random.gamma(2.0, 3e-6, SECOND_TICKS)
        records["tick_time_s"] = random.gamma(20.0, 3e-7, SECOND_TICKS)
        yield records


def _appended(file: RunFile, records: np.ndarray) -> float:
    begun = time.perf_counter()
    for start in range(0, len(records), DRAIN_TICKS):
        file.append(records[start : start + DRAIN_TICKS])
    return time.perf_counter() - begun


def _converted(file: RunFile, found: Long) -> None:
    last = file.next_tick - 1
    begun = time.process_time()
    convert(file.folder, {}, Recorded(file.began_at, last, file.extent.ticks, 0), UNKNOWN)
    found.convert_s_per_tick = (time.process_time() - begun) / found.ticks
    found.file_bytes = parquet_path(file.folder).stat().st_size
    found.overview_bytes = sum(path.stat().st_size for path in file.folder.glob("overview-*.bin"))


def _readings(folder: Path) -> dict[str, float]:
    """An overview, and windows in the middle: opened anew each time, as a request does."""
    samples = open_samples(folder)
    assert samples is not None
    first, last = samples.first_tick, samples.last_tick
    middle = (first + last) // 2

    def read(begin_tick: int, end_tick: int, points: int) -> Callable[[], object]:
        def reading() -> object:
            opened = open_samples(folder)
            assert opened is not None
            return envelope(opened, [CHANNEL], begin_tick, end_tick, points)

        return reading

    end = min(middle + WINDOW_TICKS - 1, last)
    return {
        "overview": _time(read(first, last, 2000)),
        "window_ticks": _time(read(middle, end, WINDOW_TICKS)),
        "window_bins": _time(read(middle, end, 2000)),
    }


def _time(what: Callable[[], object]) -> float:
    what()
    taken = []
    for _ in range(REPEATS):
        with _stopwatch() as watch:
            what()
        taken.append(watch[0])
    return median(taken)


@contextmanager
def _stopwatch() -> Iterator[list[float]]:
    watch = [time.perf_counter()]
    yield watch
    watch[0] = time.perf_counter() - watch[0]
