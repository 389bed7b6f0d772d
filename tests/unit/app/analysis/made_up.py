"""Made-up runs for the tests of the measurements: their values are known beforehand."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Kind, Sine, Stretch
from app.analysis.measuring import Measured, Measuring
from rtcore.channels import TELEMETRY
from rtcore.modes import Mode

PERIOD_S = 250e-6
FIRST_TICK = 5000
Records = npt.NDArray[Any]


def run_of(ticks: int, **channels: npt.ArrayLike) -> Records:
    """(ticks,) TELEMETRY of a run that goes on all the time, as of when the loop did not say where it is."""
    records = np.zeros(ticks, TELEMETRY)
    records["program_tick"] = -1
    records["tick"] = FIRST_TICK + np.arange(ticks)
    records["mode"] = Mode.RUNNING
    for name, values in channels.items():
        records[name] = values
    return records


def cycles(
    first: int, last: int, frequency_hz: float = 10.0, amplitude_n: float = 1000.0, block: int = 0
) -> Stretch:
    """A stretch of counted cycles."""
    sine = Sine(frequency_hz, amplitude_n, 0.0)
    count = round((last - first) * frequency_hz * PERIOD_S)
    return Stretch(first, last, Kind.CYCLES, ("blocks", block), sine=sine, cycles=count)


def stretch(kind: Kind, first: int, last: int, block: int = 0) -> Stretch:
    """A stretch of another kind."""
    return Stretch(first, last, kind, ("blocks", block))


def step(first: int, last: int, begin_n: float, end_n: float, block: int = 0) -> Stretch:
    """A step and the hold after it."""
    return Stretch(first, last, Kind.STEP, ("blocks", block), begin_n, end_n)


def measure(records: Records, program: Sequence[Stretch], **others: Any) -> Measured:
    """Measure a run in one chunk."""
    others.setdefault("counts_cycles", any(s.counts for s in program))
    measuring = Measuring(iter(program), PERIOD_S, **others)
    measuring.take(records)
    return measuring.result()


def in_chunks(
    records: Records, program: Sequence[Stretch], cuts: Sequence[int], **others: Any
) -> Measured:
    """Measure a run in chunks that are cut at these places."""
    others.setdefault("counts_cycles", any(s.counts for s in program))
    measuring = Measuring(iter(program), PERIOD_S, **others)
    for chunk in np.split(records, sorted(cuts)):
        measuring.take({name: chunk[name] for name in TELEMETRY.names or ()})
    return measuring.result()
