"""The block that measures a frequency response: sines one after another, or all at once."""

from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from app.definitions.adaptive import AutoLevel, AutoResolution, Confidence, RequiredBand, Settle
from app.definitions.checks import within
from app.definitions.limits import RIG
from app.definitions.multisine import Grid, Lines, chosen, grid_of_band, grid_of_list
from app.definitions.quantities import Cycles, ForceN, SettleCycles, SweptHz, SwingN, Whole
from app.documents.fields import Document, wrong
from app.documents.units import say

MIN_TO_BEND = 3  # frequencies
MOST_PLANNED = 8000  # points with all that may be needed
Points = Annotated[Whole, Field(ge=2, le=RIG.block_limit)]


class Band(Document):
    """Frequencies at equal ratios from one to another, either way."""

    from_hz: SweptHz
    to_hz: SweptHz
    points: Points

    @model_validator(mode="after")
    def _checked(self) -> Self:
        if self.from_hz == self.to_hz:
            raise wrong("to_hz", "must differ from from_hz", value=self.to_hz)
        return self


def _written_as(value: Any) -> str:
    return "band" if isinstance(value, dict | Band) else "list"


_List = Annotated[tuple[SweptHz, ...], Field(min_length=1, max_length=RIG.block_limit)]
Frequencies = Annotated[
    Annotated[_List, Tag("list")] | Annotated[Band, Tag("band")], Discriminator(_written_as)
]


def listed(asked: Frequencies) -> tuple[float, ...]:
    """As they were asked for, in Hz."""
    if isinstance(asked, Band):
        return tuple(np.geomspace(asked.from_hz, asked.to_hz, asked.points).tolist())
    return asked


def grid_of(asked: Frequencies) -> Grid:
    """The period of a multisine of these frequencies and the lines in it."""
    return (grid_of_band if isinstance(asked, Band) else grid_of_list)(listed(asked))


def refuse_long_period(grid: Grid) -> None:
    """Refuse the `frequencies_hz` of a multisine that would take long to repeat."""
    limit, period_s = RIG.multisine_limit_s, grid.period_ticks * RIG.period_s
    if period_s > limit:
        message = (
            f"these frequencies have a common period of {say(period_s, 's')}, "
            f"must be at most {say(limit, 's')}: choose multiples of one frequency"
        )
        raise wrong("frequencies_hz", message, value=period_s, limit=limit, unit="s")
    if max(grid.lines) * 2 >= grid.period_ticks:
        limit = RIG.frequency_limit_hz
        message = f"must be below {say(limit, 'Hz')}"
        raise wrong("frequencies_hz", message, limit=limit, unit="Hz")


class FrequencyResponse(Document):
    """At each mean and amplitude every frequency, settled and then measured.

    stepped_sine: one frequency after another, counted in its own cycles; with `settle`, `confidence`,
    `auto_level` and `auto_resolution` no longer, no higher and no finer than is needed. multisine: all of
    them at once, its greatest value the amplitude, counted in periods of the whole; the frequencies of a
    band move a little, so that each fits whole into the period. One realisation is of least crest; of
    several each has phases of its own. With odd `lines` only odd multiples of the common frequency are
    played, and of odd_random one in four is left out, so that distortion shows on the others.
    """

    kind: Literal["frequency_response"] = "frequency_response"
    method: Literal["stepped_sine", "multisine"] = "stepped_sine"
    mean_n: ForceN = 0.0
    means_n: tuple[ForceN, ...] | None = Field(default=None, min_length=1, max_length=100)
    amplitudes_n: tuple[SwingN, ...] = Field(min_length=1, max_length=RIG.block_limit)
    frequencies_hz: Frequencies
    settle_cycles: SettleCycles = 2
    measure_cycles: Cycles = 5
    settle: Settle | None = None
    confidence: Confidence | None = None
    auto_level: AutoLevel | None = None
    auto_resolution: AutoResolution | None = None
    realisations: Annotated[Whole, Field(ge=1, le=100)] = 1
    lines: Lines = "all"
    bands: tuple[RequiredBand, ...] = Field(default=(), max_length=20)

    @model_validator(mode="after")
    def _checked(self) -> Self:
        if self.means_n is not None and self.mean_n != 0.0:
            raise wrong("means_n", "give mean_n or means_n, not both")
        for mean_n in self.means():
            for amplitude_n in self.amplitudes_n:
                within("amplitudes_n", mean_n, amplitude_n, RIG.force_limit_n, "N")
        self._refuse_many()
        self._refuse_what_is_of_the_other_method()
        if self.method == "multisine":
            refuse_long_period(self.grid())
        return self

    @property
    def is_adaptive(self) -> bool:
        """Whether what is played is decided while it is played."""
        return any((self.settle, self.confidence, self.auto_level, self.auto_resolution))

    def means(self) -> tuple[float, ...]:
        """In N."""
        return (self.mean_n,) if self.means_n is None else self.means_n

    def frequencies(self) -> tuple[float, ...]:
        """As they were asked for, in Hz."""
        return listed(self.frequencies_hz)

    def grid(self) -> Grid:
        """The period of the multisine and the lines in it."""
        return chosen(grid_of(self.frequencies_hz), self.lines)

    def _refuse_many(self) -> None:
        points = len(self.means()) * len(self.amplitudes_n) * len(self.frequencies())
        limit = RIG.response_limit
        if points <= limit and self.method == "stepped_sine":
            levels = 1 if self.auto_level is None else len(self.auto_level.shares())
            between = 0 if self.auto_resolution is None else self.auto_resolution.points
            points, limit = points * levels * (1 + between), MOST_PLANNED
        if points > limit:
            message = f"{points:,} points in all, must be at most {limit:,}"
            raise wrong("frequencies_hz", message, value=points, limit=limit)

    def _refuse_what_is_of_the_other_method(self) -> None:
        stepped = ("settle", "confidence", "auto_level", "auto_resolution")
        multisine = {"realisations": 1, "lines": "all"}
        if self.method == "multisine":
            for name in stepped:
                if getattr(self, name) is not None:
                    raise wrong(name, "is only for the method stepped_sine")
        else:
            for name, default in multisine.items():
                if getattr(self, name) != default:
                    raise wrong(name, "is only for the method multisine")
        self._refuse_adapting_in_vain()

    def _refuse_adapting_in_vain(self) -> None:
        if self.settle is not None and self.settle.at_most_cycles <= self.settle_cycles:
            limit = self.settle_cycles
            message = f"settle.at_most_cycles must be above settle_cycles, {limit}"
            raise wrong("settle", message, value=self.settle.at_most_cycles, limit=limit)
        if self.auto_resolution is not None and len(self.frequencies()) < MIN_TO_BEND:
            message = f"at least {MIN_TO_BEND} frequencies are needed to see where a response bends"
            raise wrong("auto_resolution", message, limit=MIN_TO_BEND)
