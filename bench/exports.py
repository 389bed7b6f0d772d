"""An hour's recording in every format: how much memory at the most, and how long beside reading it once."""

import time
from collections.abc import Callable, Iterator
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pyarrow.parquet as pq

from app.errors import Refusal
from app.exports.extract import Wanted, extract
from app.exports.formats import FORMATS, FormatName, write
from app.recording.columns import as_batch
from app.recording.parquet import write_run
from bench.recorded import begin, make_test, virtual_rig
from bench.report import Figure, progress, show, tracked
from rtcore.channels import CHANNELS, TELEMETRY
from rtcore.rig.parameters import load_rig
from rtcore.virtual import PERIOD_S

HOUR_MIN = 60.0
MOST_BYTES = 400e6  # of the whole process, with the libraries that it loads; an hour is 1.4 GB
PIECE_S = 10.0
SECOND_TICKS = round(1 / PERIOD_S)


class Spent(NamedTuple):
    """By a process of its own."""

    seconds: float
    before_bytes: int  # with everything imported
    peak_bytes: int
    file_bytes: int


def main(as_json: bool, minutes: float = HOUR_MIN) -> int:
    """Measure and print; 1 where a target is missed."""
    with TemporaryDirectory(prefix="forcerig-bench-") as name:
        path = Path(name) / "run.parquet"
        record(path, minutes * 60.0)
        progress("reading the file once")
        plain = _apart(_read, path)
        figures = list(_figures(path, plain))
    ticks = round(minutes * 60.0 / PERIOD_S)
    size = f"{ticks:,} ticks × {len(CHANNELS)} channels, {ticks * TELEMETRY.itemsize / 1e6:,.0f} MB"
    tiled = (
        f"{size}; {PIECE_S:.0f} s of the virtual rig, again and again with new noise of the clock"
    )
    show("exports", figures, [tiled, "each by a process of its own"], as_json)
    return int(any(figure.met is False for figure in figures))


def record(path: Path, duration_s: float) -> None:
    """A recording through the recorder's own file code: a stretch of the virtual rig, again and again."""
    piece = _piece()
    pieces = max(1, round(duration_s / PIECE_S))
    random = np.random.default_rng(1)

    def batches() -> Iterator[Any]:
        for n in tracked(range(pieces), "recording"):
            shifted = piece.copy()
            shifted["tick"] += n * len(piece)
            shifted["time_s"] = shifted["tick"] * PERIOD_S
            shifted["wakeup_latency_s"] = random.gamma(2.0, 3e-6, len(piece))
            shifted["tick_time_s"] = random.gamma(20.0, 3e-7, len(piece))
            yield as_batch(shifted)

    write_run(path, batches(), {"test_name": "An hour", "period_ns": round(PERIOD_S * 1e9)})


def _piece() -> npt.NDArray[Any]:
    virtual = virtual_rig(load_rig())
    virtual.bring_to_ready()
    harmonic = {"kind": "harmonic", "mean_n": 0, "amplitude_n": 2000, "frequency_hz": 5}
    motion = {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4}
    lasting = {"duration_s": PIECE_S + 1.0}
    begin(virtual, make_test([harmonic | lasting], [motion | lasting]))
    return virtual.advance(round(PIECE_S * SECOND_TICKS))


def _figures(path: Path, plain: Spent) -> Iterator[Figure]:
    yield Figure("read_s", "Reading every column once", plain.seconds, "s")
    for name in FormatName:
        progress(f"writing {FORMATS[name].title}")
        spent = _apart(_export, path, name)
        title = FORMATS[name].title
        grown = f"{(spent.peak_bytes - spent.before_bytes) / 1e6:.0f} MB of it while exporting"
        yield Figure(
            *(f"{name}_peak_bytes", f"{title}: peak memory", spent.peak_bytes, "B", MOST_BYTES),
            note=grown,
        )
        yield Figure(f"{name}_s", f"{title}: time", spent.seconds, "s")
        ratio = spent.seconds / plain.seconds
        yield Figure(f"{name}_ratio", f"{title}: times reading it once", ratio, "×")
        yield Figure(f"{name}_bytes", f"{title}: file", spent.file_bytes, "B")


def _apart(work: Callable[..., int], *arguments: object) -> Spent:
    """Done by a fresh process, so that its peak is its own."""
    context = get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_measured, args=(theirs, work, arguments))
    process.start()
    theirs.close()
    spent: Spent = ours.recv()
    process.join()
    return spent


def _measured(connection: Any, work: Callable[..., int], arguments: tuple[object, ...]) -> None:
    before, begun = _peak_bytes(), time.perf_counter()
    size = work(*arguments)
    connection.send(Spent(time.perf_counter() - begun, before, _peak_bytes(), size))


def _peak_bytes() -> int:
    """Of this program alone (proc(5)): `ru_maxrss` begins with that of whoever started it."""
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) * 1024


def _read(path: Path) -> int:
    with pq.ParquetFile(path, memory_map=True) as file:
        return sum(batch.num_rows for batch in file.iter_batches(use_threads=False))


def _export(path: Path, name: FormatName) -> int:
    wanted = extract(path, Wanted())
    assert not isinstance(wanted, Refusal), wanted
    out = path.with_name(f"out.{name}")
    write(out, name, wanted, lambda share: None)
    size = out.stat().st_size
    out.unlink()
    return size
