"""What is told of a run's measurements and acquisitions."""

from typing import Literal

from pydantic import BaseModel, ConfigDict

Outcome = Literal["pass", "fail", "unset"]


class MeasuredValue(BaseModel):
    """A value; null where it was no number, as where a step never settled."""

    name: str
    unit: str
    value: float | None


class JudgedCriterion(BaseModel):
    """An acceptance criterion and what it came to; block is null where it is about the whole run."""

    model_config = ConfigDict(from_attributes=True)

    measurement: str
    block: int | None
    unit: str
    value: float | None
    at_least: float | None
    at_most: float | None
    outcome: Outcome


class BlockMeasurements(BaseModel):
    """What was measured of a block."""

    block: int
    kind: str
    measurements: list[MeasuredValue]


class RunMeasurements(BaseModel):
    """What a run amounts to; empty while it is under way."""

    verdict: Outcome
    criteria: list[JudgedCriterion]
    blocks: list[BlockMeasurements]
    run: list[MeasuredValue]


class AcquisitionColumn(BaseModel):
    """A column of a table."""

    name: str
    unit: str


class AcquisitionSummary(BaseModel):
    """A table beside the record; of a run under way, as far as it has got."""

    index: int
    kind: str
    title: str
    rows: int
    columns: list[AcquisitionColumn]


class AcquisitionRows(BaseModel):
    """Rows of a table from `from_row` on, of `rows` in all; null where there is no number."""

    from_row: int
    rows: int
    columns: dict[str, list[float | None]]
