"""Reports of an hour's run, brief and whole: how long they take, beside reading one column of the run.

The hour is played on the virtual clock, recorded through the recorder's own files and reported as the
console does it: by a process apart, which has to start, to load what draws, and to read the database.
"""

import os
import resource
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Event, Thread
from typing import Any

import pyarrow.parquet as pq
import pypdfium2

from app.db import Database
from app.errors import Refusal
from app.jobs.apart import run_apart
from app.recording.files import parquet_path
from app.reports.orders import Extent, Format, Order, Sources, carry_out
from bench.filed_run import file_run
from bench.report import Figure, progress, show

HOUR_S = 3600.0
AT_MOST_S = 5.0
BLOCKS = 34
LOOK_S = 0.02


def figures(duration_s: float) -> Iterator[Figure]:
    """Each extent and format, in a process apart; every one made anew."""
    with TemporaryDirectory(prefix="forcerig-bench-") as name:
        folder = Path(name)
        url = f"sqlite:///{folder / 'forcerig.sqlite'}"
        sources = Sources(url, folder / "runs", folder / "histories")
        run_id = _filed(url, sources.runs_dir, duration_s)
        path = parquet_path(sources.runs_dir / str(run_id))
        plain_s = _timed(lambda: pq.read_table(path, columns=["force_n"]))[0]
        size = path.stat().st_size
        yield Figure(
            "file_b", "the run's file", float(size), "B", note=f"{duration_s:.0f} s of run"
        )
        yield Figure("plain_read_s", "pyarrow reads one column whole", plain_s, "s")
        order = Order(run_id, Extent.FULL, Format.PDF, folder / "first.pdf")
        first_s, _ = _timed(lambda: run_apart(carry_out, sources, order, report=lambda _: None))
        note = "analyses the run too, and keeps that: once for every report and page of the run"
        yield Figure("first_s", "the very first, whole, PDF", first_s, "s", note=note)
        for extent in (Extent.BRIEF, Extent.FULL):
            yield from _report(
                sources, Order(run_id, extent, Format.PDF, folder / "r.pdf"), plain_s
            )
        order = Order(run_id, Extent.FULL, Format.HTML, folder / "r.html")
        yield from _report(sources, order, plain_s)


def _filed(url: str, runs_dir: Path, duration_s: float) -> int:
    progress(f"playing and recording {duration_s:.0f} s on the virtual clock")
    database = Database(url)
    database.upgrade()
    lasts_s = duration_s / BLOCKS
    blocks = [
        {
            "kind": "harmonic",
            "amplitude_n": 500.0 + 100.0 * i,
            "mean_n": 1000.0 * (i % 3 - 1),
            "frequency_hz": 4.0 + i,
            "duration_s": lasts_s,
        }
        for i in range(BLOCKS)
    ]
    motion = [
        {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "duration_s": duration_s}
    ]
    try:
        return file_run(database, runs_dir, blocks, motion, operator="Benchmark")
    finally:
        database.close()


def _report(sources: Sources, order: Order, plain_s: float) -> Iterator[Figure]:
    progress(f"{order.extent} report as {order.format}")
    watch, before_s = _Peak(), _processor_s()
    taken_s, found = _timed(lambda: run_apart(carry_out, sources, order, report=watch.look))
    if isinstance(found, Refusal):
        raise RuntimeError(found.detail)
    key, what = f"{order.extent}_{order.format}", f"{order.extent} report, {order.format.upper()}"
    note = f"{taken_s / plain_s:.0f} × the plain read; {_size(order)}"
    yield Figure(f"{key}_s", what, taken_s, "s", AT_MOST_S, note=note)
    spent_s = _processor_s() - before_s
    what_spent = f"{what}: processor time"
    yield Figure(
        f"{key}_processor_s", what_spent, spent_s, "s", note="whatever else there is to do"
    )
    yield Figure(f"{key}_peak_b", f"{what}: its process's memory", float(watch.close()), "B")


def _processor_s() -> float:
    """What the processes that have ended have had of the processors."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _size(order: Order) -> str:
    written = f"{order.path.stat().st_size / 1e6:.1f} MB"
    if order.format is Format.HTML:
        return written
    document = pypdfium2.PdfDocument(order.path)
    try:
        return f"{len(document)} pages, {written}"
    finally:
        document.close()


def _timed(what: Callable[[], Any]) -> tuple[float, Any]:
    begun = time.perf_counter()
    found = what()
    return time.perf_counter() - begun, found


class _Peak:
    """The most memory that any child of this process has had, looked at while it works."""

    def __init__(self) -> None:
        self._peak, self._over = 0, Event()
        self._thread = Thread(target=self._watch)
        self._thread.start()

    def look(self, share: float) -> None:
        """As progress is told."""

    def close(self) -> int:
        """In bytes."""
        self._over.set()
        self._thread.join()
        return self._peak

    def _watch(self) -> None:
        while not self._over.wait(LOOK_S):
            for task in Path(f"/proc/{os.getpid()}/task").iterdir():
                for child in _read(task / "children").split():
                    self._peak = max(self._peak, _resident_peak(Path("/proc") / child / "status"))


def _resident_peak(status: Path) -> int:
    lines = dict(line.split(":", 1) for line in _read(status).splitlines() if ":" in line)
    return 1024 * int(lines.get("VmHWM", "0 kB").split()[0])


def _read(path: Path) -> str:
    try:
        return path.read_text()
    except OSError:
        return ""  # it has ended meanwhile


NOTES = [
    f"a test of {BLOCKS} harmonic blocks while the unit moves; page cache warm",
    "time from the order to the file in place: start of the process, loading, analysis, drawing, setting",
    "memory: VmHWM of the process, pages of mapped files included",
]


def main(as_json: bool, minutes: float = HOUR_S / 60.0) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    show("reports", list(figures(minutes * 60.0)), NOTES, as_json)
    return 0
