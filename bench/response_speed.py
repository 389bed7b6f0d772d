"""`forcerig bench response_speed`: the stepped-sine analysis of an hour, against a plain script of scipy's.

An hour of columns, 100 points of 36 s each, is taken as a run's analysis takes it: through `Walk`, in
chunks of a second. The script does the same with `scipy.signal` and python-control as their manuals would
have it: for each point the cross spectra of whole cycles, the coherence and the spectrum of the output
for its distortion, and a `control.frd` of each transfer.
"""

import time
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import control
import numpy as np
import numpy.typing as npt
from scipy import signal

from app.analysis.evidence import Kind, Sine, Stretch
from app.analysis.response.point import ResponsePoint
from app.analysis.response.stepped import SteppedSine, channels_of
from app.analysis.response.transfers import MOTION_TRANSFERS, TRANSFERS
from app.analysis.walk import Walk
from bench.report import Figure, progress, show
from rtcore.channels import TELEMETRY
from rtcore.modes import Mode

PERIOD_S = 250e-6
POINTS, POINT_S, CHUNK_S = 100, 36, 1
SHOWN = TRANSFERS | MOTION_TRANSFERS
TIMES_FASTER = 10.0
SHARE = 0.1  # of the points that the script is timed on
T = TypeVar("T")
HARMONICS = 10
Columns = Mapping[str, npt.NDArray[Any]]
Program = list[Stretch]


def an_hour(points: int = POINTS) -> tuple[Columns, Program]:
    """Columns and program of a run that steps from 1 to 100 Hz; what a linear rig with noise would give."""
    ticks = round(POINT_S / PERIOD_S)
    total = points * ticks
    frequencies = np.geomspace(1, 100, points)
    rng = np.random.default_rng(1)
    columns: dict[str, npt.NDArray[Any]] = {
        name: np.zeros(total, TELEMETRY[name]) for name in TELEMETRY.names or ()
    }
    columns["tick"][:] = columns["program_tick"][:] = np.arange(total)
    columns["mode"][:] = Mode.RUNNING
    program = []
    for i, hz in enumerate(frequencies):
        at = slice(i * ticks, (i + 1) * ticks)
        phase = 2 * np.pi * hz * PERIOD_S * np.arange(ticks)
        for k, name in enumerate(channels_of(SHOWN.values())):
            lag = 0.1 * k * hz / 10
            noise = rng.normal(0, 5, ticks)
            columns[name][at] = 2000 * np.sin(phase - lag) + 40 * np.sin(2 * phase) + noise
        sine = Sine(float(hz), 2000.0, 0.0)
        program.append(Stretch(at.start, at.stop, Kind.CYCLES, sine=sine, cycles=1))
    return columns, program


def ours(columns: Columns, program: Program) -> list[ResponsePoint]:
    """As after a run: chunk after chunk."""
    walk = Walk(iter(program), PERIOD_S, also=channels_of(SHOWN.values()))
    stepped = SteppedSine(PERIOD_S, SHOWN)
    step = round(CHUNK_S / PERIOD_S)
    for first in range(0, len(columns["tick"]), step):
        for part in walk.take({name: c[first : first + step] for name, c in columns.items()}):
            stepped.take(part)
    return stepped.points()


def script(columns: Columns, program: Program) -> dict[str, Any]:
    """As one would write it with scipy.signal and python-control; one `frd` a transfer."""
    rate_hz = 1 / PERIOD_S
    found: dict[str, list[complex]] = {name: [] for name in SHOWN}
    for stretch in program:
        assert stretch.sine is not None, "each stretch has one"
        hz = stretch.sine.frequency_hz
        at = slice(stretch.first, stretch.last)
        size = round(max(4, 2 * round(hz)) / hz / PERIOD_S)  # whole cycles, about two seconds
        for name, transfer in SHOWN.items():
            u, y = columns[transfer.input][at], columns[transfer.output][at]
            f, crossed = signal.csd(u, y, rate_hz, "hann", size)
            _, power = signal.welch(u, rate_hz, "hann", size)
            _, coherence = signal.coherence(u, y, rate_hz, "hann", size)
            line = int(np.argmin(np.abs(f - hz)))
            found[name].append(complex(crossed[line] / power[line]))
            spectrum = np.abs(np.fft.rfft(y - y.mean()))
            first = round(hz * len(y) * PERIOD_S)
            np.linalg.norm(spectrum[2 * first : (HARMONICS + 1) * first : first]) / spectrum[first]
            assert coherence[line] <= 1 + 1e-6, "or scipy has another idea of it"
    omega = [2 * np.pi * s.sine.frequency_hz for s in program if s.sine is not None]
    return {name: control.frd(np.array(values), omega) for name, values in found.items()}


def sum_of_all(columns: Columns) -> float:
    """What the memory alone costs: every value of the channels read once."""
    names = channels_of(SHOWN.values())
    return float(sum(float(columns[name].sum(dtype=np.float32)) for name in names))


def timed(what: Callable[[], T]) -> tuple[T, float]:
    """What it gives, and the processor's time that it took: other work does not count."""
    began = time.process_time()
    made = what()
    return made, time.process_time() - began


def figures() -> list[Figure]:
    """Both on the same columns, and what reading them costs."""
    columns, program = an_hour()
    progress("an hour of 14.4 million ticks")
    ours({name: c[:8000] for name, c in columns.items()}, program)
    points, own_s = timed(lambda: ours(columns, program))
    progress("the script")
    few = program[:: round(1 / SHARE)]
    frd, few_s = timed(lambda: script(columns, few))
    script_s = few_s / SHARE
    _, read_s = timed(lambda: sum_of_all(columns))
    force = [p for p in points if p.transfer == "force"][:: round(1 / SHARE)]
    gains = np.abs(frd["force"].frdata[0, 0])
    apart = max(abs(p.gain / gain - 1) for p, gain in zip(force, gains, strict=True))
    return [
        Figure("hour_s", f"an hour analysed, {len(SHOWN)} transfers, intervals", own_s, "s"),
        Figure("script_s", "the script of scipy and python-control", script_s, "s"),
        Figure("ratio", "times faster", script_s / own_s, "×", at_least=TIMES_FASTER),
        Figure("read_s", "every value read once and summed up", read_s, "s"),
        Figure("memory_ratio", "analysis over reading", own_s / read_s, "×"),
        Figure("times_real_time", "times real time", 3600 / own_s, "×"),
        Figure("apart_share", "gains apart at worst, share", float(apart), "-", at_most=0.01),
    ]


def main(as_json: bool) -> int:
    """Measure and print."""
    found = figures()
    notes = [
        f"{POINTS} points of {POINT_S} s at 4 kHz in chunks of {CHUNK_S} s; seconds of one processor",
        "the script is timed on every tenth point",
        "the script has no intervals and no settling, and looks at a window of two seconds at a time",
    ]
    show("response_speed", found, notes, as_json)
    return int(any(figure.met is False for figure in found))
