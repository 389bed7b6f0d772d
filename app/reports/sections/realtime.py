"""Real-time quality: what the loop was given, what it missed, and when its ticks began."""

import numpy as np
import numpy.typing as npt

from app.reports.figures.plain import histogram
from app.reports.numbers import duration
from app.reports.report import Column, Facts, Figure, Item, Row, Section, Table, Tone, Words
from app.reports.subject import Subject

NAMES = ("wakeup_latency_s", "tick_time_s")
BIN_S = 2e-6
BINS = 500  # what is longer lies in the last one: 1 ms


class Timing:
    """Counts ticks by how late they began and how long they took, in flat memory."""

    def __init__(self) -> None:
        self.counts = {name: np.zeros(BINS, np.int64) for name in NAMES}
        self.longest = dict.fromkeys(NAMES, 0.0)
        self.missed = 0
        self._before: int | None = None

    def take(self, columns: dict[str, npt.NDArray[np.float32]]) -> None:
        """The next ticks."""
        for name in NAMES:
            values = columns[name]
            bins = np.nan_to_num(values * np.float32(1.0 / BIN_S), nan=BINS, posinf=BINS)
            places = np.clip(bins, 0, BINS - 1).astype(np.intp)
            self.counts[name] += np.bincount(places, minlength=BINS)
            if len(values):
                self.longest[name] = max(self.longest[name], float(np.nanmax(values, initial=0.0)))
        missed = columns["deadlines_missed"]
        if len(missed):
            before = int(missed[0]) if self._before is None else self._before
            self.missed += int(missed[-1]) - before
            self._before = int(missed[-1])

    def quantile_s(self, name: str, share: float) -> float:
        """Upper end of the bin in which it lies."""
        total = np.cumsum(self.counts[name])
        return float((np.searchsorted(total, share * total[-1]) + 1) * BIN_S)


def realtime(subject: Subject) -> Section | None:
    """Missed ticks, conditions and histograms; of a run on the virtual clock that there was none."""
    if subject.virtual:
        text = "The run was made on the virtual clock: it has no wake-ups, and no tick can be late."
        return Section("Real-time quality", (Words(text),))
    items: list[Item] = []
    if subject.samples is not None:
        items += _timing(subject)
    if subject.frozen.conditions:
        items.append(_conditions(subject))
    return Section("Real-time quality", tuple(items)) if items else None


def _timing(subject: Subject) -> list[Item]:
    found = Timing()
    samples = subject.samples
    assert samples is not None
    wanted = (*NAMES, "deadlines_missed")
    for chunk in samples.chunks(wanted, samples.first_tick, samples.last_tick):
        found.take(dict(chunk))
    facts = [
        ("Ticks recorded", f"{subject.ticks:,}"),
        ("Ticks not recorded", f"{subject.missing_ticks:,}"),
        ("Deadlines missed", f"{found.missed:,}"),
        ("Period", duration(subject.period_s)),
    ]
    for name, words in zip(NAMES, ("Wake-up after its deadline", "Tick"), strict=True):
        told = [
            f"{p:g} % within {duration(found.quantile_s(name, p / 100))}" for p in (50, 99, 99.99)
        ]
        facts.append((words, f"{', '.join(told)}; longest {duration(found.longest[name])}"))
    counts = [
        ("Wake-up after its deadline", found.counts[NAMES[0]]),
        ("Time that a tick took", found.counts[NAMES[1]]),
    ]
    caption = (
        "Ticks by how late they began and how long they took; the last bin has all that is longer"
    )
    svg = histogram(counts, BIN_S * 1e6, "µs")
    return [Facts(tuple(facts)), Figure(caption, svg, caption)]


def _conditions(subject: Subject) -> Table:
    columns = (
        Column("Condition", share=2.0),
        Column("Had", share=0.7),
        Column("What was got, or why not", share=6.0),
    )
    rows = tuple(
        Row(
            (str(c["name"]), "yes" if c["had"] else "no", str(c["reason"])),
            Tone.PLAIN if c["had"] else Tone.BAD,
        )
        for c in subject.frozen.conditions
    )
    return Table("Real-time conditions", columns, rows)
