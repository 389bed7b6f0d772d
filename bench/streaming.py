"""A day's time history through the rings of its bank: from a CSV file to every tick's setpoint, in flat memory."""

import os
import resource
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.interpolate import PchipInterpolator

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import load_definition
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from bench.report import Figure, progress, show, tracked
from rtcore.codes import Opcode, Reply
from rtcore.modes import Mode
from rtcore.virtual import PERIOD_S, Virtual

RATE_HZ = 100.0
HOURS = float(os.environ.get("FORCERIG_BENCH_HOURS", "1"))
CHUNK_TICKS = 40_000
LOOKED_AT_EVERY = 25  # of the chunks, beside the first and the last
FLAT_BYTES = 64e6

TEST = """schema: 1
name: A flight of many hours
blocks:
  - {kind: time_history, file: flight.csv}
"""


def load_n(sample: npt.NDArray[np.int64]) -> npt.NDArray[np.float64]:
    """A load of many incommensurate parts, zero at its beginning; N, rounded as a file would have it."""
    t = sample / RATE_HZ
    parts = ((3000.0, 0.0137), (2500.0, 0.311), (1800.0, 1.93), (900.0, 7.7), (300.0, 13.3))
    total = sum(peak * np.sin(2 * np.pi * hz * t) for peak, hz in parts)
    return np.asarray(np.round(total, 3))


def write_csv(path: Path, samples: int) -> None:
    """The history as a file of times and forces."""
    with path.open("w", encoding="ascii") as file:
        file.write("time (s),force (N)\n")
        for first in tracked(range(0, samples, 100_000), "writing the file"):
            index = np.arange(first, min(first + 100_000, samples))
            rows = zip((index / RATE_HZ).tolist(), load_n(index).tolist(), strict=True)
            file.writelines(f"{t:.2f},{force:.3f}\n" for t, force in rows)


def resident_bytes() -> int:
    """Memory that this process has now, files that are mapped left out."""
    fields = Path("/proc/self/status").read_text().split()
    return int(fields[fields.index("RssAnon:") + 1]) * 1024


def expected_n(first_tick: int, ticks: int, samples: int) -> npt.NDArray[np.float64]:
    """The monotone curve of scipy through the samples, at ticks of the history."""
    knot_ticks = 1.0 / (RATE_HZ * PERIOD_S)
    first_tick = max(first_tick, 0)
    low = max(0, int(first_tick / knot_ticks) - 3)
    high = min(samples, int((first_tick + ticks) / knot_ticks) + 5)
    knots = np.arange(low, high)
    curve = PchipInterpolator(knots * knot_ticks, load_n(knots))
    return np.asarray(curve(first_tick + np.arange(ticks)))


def chunks(virtual: Virtual, ticks: int) -> Iterator[npt.NDArray[Any]]:
    """The run, chunk by chunk, until the history is over."""
    for first in tracked(range(0, ticks, CHUNK_TICKS), "playing it"):
        yield virtual.advance(min(CHUNK_TICKS, ticks - first))


def play(definition: Definition, samples: int) -> Iterator[Figure]:
    """Play it whole, and hold stretches of it against the curve."""
    lead_ticks = int(next(iter(expand(definition).force.segments))[0]["ticks"])
    ticks = lead_ticks + round((samples - 1) / (RATE_HZ * PERIOD_S))
    gains = gains_record(ControllerSettings())
    virtual = Virtual(gains, interlocks_record(default_interlocks(), PERIOD_S))
    virtual.bring_to_ready()
    assert virtual.load_program(expand(definition)) == Reply.ACCEPTED
    assert virtual.command(Opcode.START, 1) == Reply.ACCEPTED
    began, worst_n, looked, memory = time.perf_counter(), 0.0, 0, [resident_bytes()]
    first = 1  # the command has played one
    for number, records in enumerate(chunks(virtual, ticks - 1)):
        if number % LOOKED_AT_EVERY == 0 or first + len(records) >= ticks:
            mine = records["force_command_n"][max(0, lead_ticks - first) :]
            error = mine - expected_n(first - lead_ticks, len(mine), samples)
            worst_n, looked = max(worst_n, float(np.abs(error).max())), looked + len(records)
            memory.append(resident_bytes())
        first += len(records)
    seconds = time.perf_counter() - began
    virtual.advance(round(1.0 / PERIOD_S))
    ended = "to its end" if virtual.mode == Mode.READY else f"not: {virtual.mode.name.lower()}"
    least_s = HOURS * 3600 if virtual.mode == Mode.READY else np.inf
    yield Figure(
        "played_s", f"time history, played {ended}", ticks * PERIOD_S, "s", at_least=least_s
    )
    yield Figure("samples", "samples in the file", samples, "")
    yield Figure("real_time", "whole tick, streamed / real time", ticks * PERIOD_S / seconds, "×")
    what = f"setpoint against scipy's curve, {looked:,} ticks"
    yield Figure("setpoint_error_mn", what, 1e3 * worst_n, "mN", at_most=1.0)
    growth = max(memory) - memory[0]
    yield Figure("growth_b", "growth of memory while it plays", growth, "B", at_most=FLAT_BYTES)


def main(as_json: bool) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    samples = round(HOURS * 3600 * RATE_HZ) + 1
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_csv(folder / "flight.csv", samples)
        (folder / "test.yaml").write_text(TEST)
        progress("reading the file")
        began = time.perf_counter()
        definition = load_definition(folder / "test.yaml")
        reading_s = time.perf_counter() - began
        assert isinstance(definition, Definition), definition.detail
        figures = list(play(definition, samples))
    figures.append(Figure("reading_s", "CSV file read, checked and measured", reading_s, "s"))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    figures.append(Figure("peak_b", "most memory ever, mapped files included", peak, "B"))
    notes = [
        f"{HOURS:g} h at {RATE_HZ:g} Hz; FORCERIG_BENCH_HOURS=24 plays a day (about seven minutes)",
        "the very tick on the virtual clock; the rings hold 65,536 samples, the rest is streamed",
    ]
    show("streaming", figures, notes, as_json)
    return 0
