"""Which moments of a run tell most: the first step, else the middle of its longest block."""

from typing import NamedTuple

from app.reports.subject import Subject

SHOWN_S = 0.25
BEFORE_S = 0.02  # of a step, so that it is seen from where
CYCLES = 8
_SUDDEN = ("step", "ramp")


class Moment(NamedTuple):
    """From when to when (s), and in words."""

    from_s: float
    to_s: float
    text: str


def moment_of_run(subject: Subject) -> Moment:
    """Of the whole run."""
    spans = spans_of(subject)
    asked = subject.frozen.definition["blocks"]
    sudden = [block for block in spans if asked[block]["kind"] == "step"]
    if sudden:
        return moment_of_block(subject, sudden[0])
    if spans:
        longest = max(spans, key=lambda block: spans[block][1] - spans[block][0])
        return moment_of_block(subject, longest)
    return _middle(0.0, subject.ticks * subject.period_s, SHOWN_S, "the run")


def moment_of_block(subject: Subject, block: int) -> Moment:
    """Of one block that was reached."""
    from_s, to_s = spans_of(subject)[block]
    asked = subject.frozen.definition["blocks"][block]
    name = f"block {block + 1}"
    if asked["kind"] in _SUDDEN:
        start = max(0.0, from_s - BEFORE_S)
        return Moment(start, min(start + SHOWN_S, to_s), f"the beginning of {name}")
    frequency = asked.get("frequency_hz")
    cyclic = isinstance(frequency, int | float) and frequency > 0
    return _middle(from_s, to_s, CYCLES / frequency if cyclic else SHOWN_S, name)


def spans_of(subject: Subject) -> dict[int, tuple[float, float]]:
    """From when to when each block went on, by what the loop reported; -1 is none of them."""
    starts = [e for e in subject.events if e.kind == "block"]
    ends = [*(e.time_s for e in starts[1:]), subject.ticks * subject.period_s]
    known = len(subject.frozen.definition["blocks"])
    spans = {}
    for event, end in zip(starts, ends, strict=True):
        block = int(event.code)
        if 0 <= block < known and end > event.time_s:
            spans[block] = (event.time_s, end)
    return spans


def _middle(from_s: float, to_s: float, shown_s: float, name: str) -> Moment:
    shown_s = min(shown_s, to_s - from_s)
    start = 0.5 * (from_s + to_s - shown_s)
    return Moment(start, start + shown_s, f"the middle of {name}")
