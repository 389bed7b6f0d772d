"""A test as people write it: schema 1 of the test definition (YAML or JSON)."""

from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Field, PlainSerializer, model_validator

from app.analysis.measurements import MEASUREMENTS
from app.definitions.blocks import Block
from app.definitions.limits import RIG
from app.definitions.motions import Motion
from app.definitions.nodes import Compensation
from app.definitions.quantities import DurationS, Number, SampleRateHz, Whole
from app.definitions.whole import Found, problems_of
from app.documents.fields import Document, all_wrong, wrong
from app.documents.messages import nearest
from rtcore.channels import CHANNEL


def _available(adaptive: str) -> str:
    if adaptive != "off":
        message = f"{adaptive} is not available yet in this version of forcerig; use off"
        raise wrong("", message, value=adaptive)
    return adaptive


def _known_channel(name: str) -> str:
    if name not in CHANNEL:
        raise wrong("", f"unknown channel '{name}'{nearest(name, CHANNEL)}", value=name)
    return name


def _known_measurement(name: str) -> str:
    if name not in MEASUREMENTS:
        guess = nearest(name, MEASUREMENTS) or f"; known: {', '.join(MEASUREMENTS)}"
        raise wrong("", f"unknown measurement '{name}'{guess}", value=name)
    return name


class ControllerChoice(Document):
    """What the test asks of the controller. auto: compensation for harmonic loads only."""

    compensation: Compensation = "auto"
    adaptive: Annotated[Literal["off", "amplitude_phase"], AfterValidator(_available)] = "off"


ALL_CHANNELS = tuple(CHANNEL)
Channels = Annotated[
    tuple[Annotated[str, AfterValidator(_known_channel)], ...],
    BeforeValidator(lambda value: ALL_CHANNELS if value == "all" else value),
    PlainSerializer(lambda value: "all" if value == ALL_CHANNELS else list(value)),
    Field(min_length=1, max_length=len(ALL_CHANNELS)),
]


class Timed(Document):
    """A row at a rate."""

    kind: Literal["timed"] = "timed"
    rate_hz: SampleRateHz


class PeakValley(Document):
    """The peak and the valley of every cycle."""

    kind: Literal["peak_valley"] = "peak_valley"


class MaxMin(Document):
    """The greatest and the least of every so many seconds."""

    kind: Literal["max_min"] = "max_min"
    every_s: DurationS


class LogarithmicCycles(Document):
    """Every tick of cycles 1, 2, 5, 10, 20, 50 and so on."""

    kind: Literal["logarithmic_cycles"] = "logarithmic_cycles"


Acquisition = Annotated[
    Timed | PeakValley | MaxMin | LogarithmicCycles, Field(discriminator="kind")
]


class Recording(Document):
    """Which channels the test is about (`all`); the recording itself always holds every one.

    `also` is what is kept beside it, each in a table of its own.
    """

    channels: Channels = ALL_CHANNELS
    also: tuple[Acquisition, ...] = Field(default=(), max_length=20)


class Criterion(Document):
    """A measurement and the limits within which it passes, of one block or of the whole run."""

    measurement: Annotated[str, AfterValidator(_known_measurement)]
    block: Annotated[Whole, Field(ge=0)] | None = None
    at_least: Number | None = None
    at_most: Number | None = None

    @model_validator(mode="after")
    def _checked(self) -> Self:
        if self.at_least is None and self.at_most is None:
            raise wrong("at_most", "at_least or at_most is needed")
        low, high = self.at_least, self.at_most
        if low is not None and high is not None and low > high:
            message = f"{high:,g} must not be below at_least, {low:,g}"
            raise wrong("at_most", message, value=high, limit=low)
        return self


class Definition(Document):
    """A test: what the force does, what the unit under test does meanwhile, and what passes."""

    schema_version: Literal[1] = Field(alias="schema")
    name: str = Field(min_length=1, max_length=200)
    description: str = Field(default="", max_length=10_000)
    controller: ControllerChoice = ControllerChoice()
    blocks: tuple[Block, ...] = Field(min_length=1, max_length=RIG.block_limit)
    motion: tuple[Motion, ...] = Field(default=(), max_length=RIG.block_limit)
    record: Recording = Recording()
    acceptance: tuple[Criterion, ...] = Field(default=(), max_length=100)

    @model_validator(mode="after")
    def _within_the_rig(self) -> Self:
        problems = [*problems_of(self.blocks, self.motion), *self._unknown_blocks()]
        if problems:
            raise all_wrong("Definition", problems)
        return self

    def _unknown_blocks(self) -> Iterator[Found]:
        last = len(self.blocks) - 1
        for i, criterion in enumerate(self.acceptance):
            if criterion.block is not None and criterion.block > last:
                message = f"there is no block {criterion.block}: the last is {last}"
                error = wrong("block", message, value=criterion.block, limit=last)
                yield ("acceptance", i), error
