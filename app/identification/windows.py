"""Windows of recorded runs: what drove the rig, and what was measured of it, ready to be simulated."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.identification.model import DELAY_TICKS, DISPLACEMENT, DRIVING, MEASURED
from app.identification.noise import held
from app.recording.samples import Samples
from rtcore.modes import Mode

Floats = npt.NDArray[np.float64]

LENGTH = 1600  # ticks that are compared, 0.4 s
RUN_UP = 800  # ticks before them, in which what is not known of the start dies out
SLOPE = 20  # ticks over which the unit's speed at the start is taken, on either side
BEFORE = RUN_UP + max(DELAY_TICKS, SLOPE) + 1
AFTER = 1
GOLDEN = 0.6180339887498949
_COLUMNS = ("mode", "trips", *DRIVING, *MEASURED)


@dataclass(frozen=True)
class Source:
    """A recorded run."""

    run_id: int
    samples: Samples
    bits: int  # of its converters


@dataclass(frozen=True)
class Window:
    """Some ticks of a run: `start` (8,), `driving` (RUN_UP + LENGTH, 2) and `measured` (LENGTH, 7)."""

    source: int  # which of the sources
    first_tick: int
    start: Floats
    driving: Floats
    measured: Floats


def candidates(sources: Sequence[Source], count: int, period_s: float) -> Iterator[Window]:
    """About so many windows, spread over all runs, none of which has a gap, a trip or a hold in it."""
    lengths = [s.samples.last_tick - s.samples.first_tick + 1 for s in sources]
    stretch = max(sum(lengths) // max(count, 1), LENGTH)
    for i, (source, ticks) in enumerate(zip(sources, lengths, strict=True)):
        usable = ticks - BEFORE - LENGTH - AFTER
        for k in range(max(0, usable // stretch)):
            # Not evenly: a test that repeats itself would show the same of each repetition.
            at = (k + (k * GOLDEN) % 1.0 * (1.0 - LENGTH / stretch)) * stretch
            window = read(sources, i, source.samples.first_tick + BEFORE + round(at), period_s)
            if window is not None:
                yield window


def read(sources: Sequence[Source], which: int, first_tick: int, period_s: float) -> Window | None:
    """The window of a run whose first compared tick is given; None where it cannot be used."""
    source = sources[which]
    low, high = first_tick - BEFORE, first_tick + LENGTH + AFTER
    chunks = list(source.samples.chunks(_COLUMNS, low, high))
    columns = {
        name: np.concatenate([c[name] for c in chunks] or [np.zeros(0)])
        for name in ("tick", *_COLUMNS)
    }
    whole = len(columns["tick"]) == high - low + 1
    if not whole or np.any(columns["mode"] != Mode.RUNNING) or np.any(columns["trips"]):
        return None
    measured = np.column_stack([columns[name].astype(np.float64) for name in MEASURED])
    driving = np.column_stack([columns[name].astype(np.float64) for name in DRIVING])
    if not (np.isfinite(measured).all() and np.isfinite(driving).all()):
        return None
    driving[:, 0] = held(driving[:, 0], source.bits)
    begin = BEFORE - RUN_UP
    moved_m = measured[begin + SLOPE, DISPLACEMENT] - measured[begin - SLOPE, DISPLACEMENT]
    start = np.append(measured[begin - 1], moved_m / (2 * SLOPE * period_s))
    drive = driving[begin - DELAY_TICKS : BEFORE + LENGTH - DELAY_TICKS].copy()
    return Window(which, first_tick, start, drive, measured[BEFORE : BEFORE + LENGTH])
