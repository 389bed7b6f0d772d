"""The block that measures a frequency response: sines one after another, or all at once."""

from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from app.definitions.checks import within
from app.definitions.limits import RIG
from app.definitions.multisine import Grid, grid_of_band, grid_of_list
from app.definitions.quantities import Cycles, ForceN, SettleCycles, SweptHz, SwingN, Whole
from app.documents.fields import Document, wrong
from app.documents.units import say

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


class FrequencyResponse(Document):
    """At each amplitude every frequency, settled and then measured.

    stepped_sine: one frequency after another, counted in its own cycles. multisine: all of them at
    once, of least crest, its greatest value the amplitude, counted in periods of the whole; the
    frequencies of a band move a little, so that each fits whole into the period.
    """

    kind: Literal["frequency_response"] = "frequency_response"
    method: Literal["stepped_sine", "multisine"] = "stepped_sine"
    mean_n: ForceN = 0.0
    amplitudes_n: tuple[SwingN, ...] = Field(min_length=1, max_length=RIG.block_limit)
    frequencies_hz: Frequencies
    settle_cycles: SettleCycles = 2
    measure_cycles: Cycles = 5

    @model_validator(mode="after")
    def _checked(self) -> Self:
        for amplitude_n in self.amplitudes_n:
            within("amplitudes_n", self.mean_n, amplitude_n, RIG.force_limit_n, "N")
        points = len(self.amplitudes_n) * len(self.frequencies())
        if points > RIG.response_limit:
            message = f"{points:,} points in all, must be at most {RIG.response_limit:,}"
            raise wrong("frequencies_hz", message, value=points, limit=RIG.response_limit)
        if self.method == "multisine":
            self._refuse_long_period()
        return self

    def frequencies(self) -> tuple[float, ...]:
        """As they were asked for, in Hz."""
        asked = self.frequencies_hz
        if isinstance(asked, Band):
            return tuple(np.geomspace(asked.from_hz, asked.to_hz, asked.points).tolist())
        return asked

    def grid(self) -> Grid:
        """The period of the multisine and the lines in it."""
        banded = isinstance(self.frequencies_hz, Band)
        return (grid_of_band if banded else grid_of_list)(self.frequencies())

    def _refuse_long_period(self) -> None:
        grid, limit = self.grid(), RIG.multisine_limit_s
        period_s = grid.period_ticks * RIG.period_s
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
