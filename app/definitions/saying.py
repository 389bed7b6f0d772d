"""What is particular to a block or motion, in a few words: what a table of its extent does not show."""

from collections.abc import Callable
from typing import Any

from app.definitions.blocks import Block, Layers, Repeat, Sweep
from app.definitions.courses import TimeCourse
from app.definitions.limits import RIG
from app.definitions.motions import Motion, MotionMultisine
from app.definitions.responses import FrequencyResponse
from app.documents.units import say


def in_words(item: Block | Motion) -> str:
    """`1 Hz to 100 Hz at 0.5 octaves/s`; empty where there is nothing more to say."""
    found = next((words for kind, words in _WORDS if isinstance(item, kind)), None)
    return found(item) if found else ""


def _sweep(b: Sweep) -> str:
    pace = (
        f"at {say(b.rate_octaves_s, 'octaves/s')}"
        if b.rate_octaves_s
        else f"in {say(b.duration_s, 's')}"
    )
    return f"{say(b.from_hz, 'Hz')} to {say(b.to_hz, 'Hz')} {pace}, {b.law}"


def _response(b: FrequencyResponse) -> str:
    amplitudes = ", ".join(say(amplitude, "N") for amplitude in b.amplitudes_n)
    asked = b.grid().frequencies_hz() if b.method == "multisine" else b.frequencies()
    band = f"{say(min(asked), 'Hz')} to {say(max(asked), 'Hz')}"
    what = f"{b.method.replace('_', ' ')}, {len(asked)} frequencies, {band}, at {amplitudes}"
    if b.method == "multisine":
        return f"{what}, period {say(b.grid().period_ticks * RIG.period_s, 's')}"
    return what


def _motion_multisine(m: MotionMultisine) -> str:
    grid = m.grid()
    hz = grid.frequencies_hz()
    return (
        f"{len(hz)} frequencies, {say(min(hz), 'Hz')} to {say(max(hz), 'Hz')}, {m.realisations} "
        f"realisations, period {say(grid.period_ticks * RIG.period_s, 's')}"
    )


def _history(b: TimeCourse) -> str:
    found = b.history
    times = f", {b.repeats:,} times" if b.repeats > 1 else ""
    return (
        f"{b.file or 'samples'}: {found.statistics.samples:,} at {say(found.rate_hz, 'Hz')}, "
        f"up to {say(found.bandwidth_hz, 'Hz')}{times}"
    )


_WORDS: tuple[tuple[type, Callable[[Any], str]], ...] = (
    (Sweep, _sweep),
    (FrequencyResponse, _response),
    (MotionMultisine, _motion_multisine),
    (TimeCourse, _history),
    (Layers, lambda b: f"{len(b.layers)} layers, {b.repeats:,} times"),
    (Repeat, lambda b: f"{', '.join(inner.kind for inner in b.blocks)}, {b.times:,} times"),
)
