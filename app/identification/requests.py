"""What the requests about identifications take and give."""

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.identification.models import Identification, State
from app.identification.schemas import MOST_RUNS, Fit, Goodness, Identified
from app.revisions.schemas import Why

RunNumber = Annotated[int, Field(ge=1, le=2**53)]


class IdentificationRequest(Fit):
    """Runs to fit the model to, and which of its parameters."""

    run_ids: tuple[RunNumber, ...] = Field(min_length=1, max_length=MOST_RUNS)


class AdoptRequest(BaseModel):
    """Why the fitted model comes into force; `lease` is the epoch of one's own."""

    model_config = ConfigDict(extra="forbid")

    why: Why
    lease: Annotated[int, Field(ge=0, le=2**53)] | None = None


class FittableParameter(BaseModel):
    """A parameter that can be fitted, with its value in the model in force."""

    path: str
    title: str
    unit: str
    group: str
    value: float


class IdentificationSummary(BaseModel):
    """An identification; `share` is how much of it is done, `reason` why nothing came of it.

    `based_on` is the revision of the rig configuration whose model it began with.
    """

    id: int
    state: State
    share: float
    seconds_left: float | None
    run_ids: list[int]
    author: str
    created_at: datetime
    ended_at: datetime | None
    reason: str | None
    based_on: int
    adopted_revision: int | None
    goodness: Goodness | None


class IdentificationOut(IdentificationSummary):
    """With what was asked for, and all that came of it."""

    fit: Fit
    result: Identified | None


def summary(row: Identification, share: float, seconds_left: float | None) -> IdentificationSummary:
    """A row as a list shows it."""
    return IdentificationSummary.model_validate(_fields(row, share, seconds_left))


def detail(row: Identification, share: float, seconds_left: float | None) -> IdentificationOut:
    """A row with all that came of it."""
    more = {"fit": row.fit, "result": row.result}
    return IdentificationOut.model_validate(_fields(row, share, seconds_left) | more)


def _fields(row: Identification, share: float, seconds_left: float | None) -> dict[str, object]:
    names = set(IdentificationSummary.model_fields) - {"share", "seconds_left", "goodness"}
    fields: dict[str, object] = {name: getattr(row, name) for name in names}
    goodness = None if row.result is None else row.result["goodness"]
    share = 1.0 if row.state == State.DONE else share
    return fields | {"share": share, "seconds_left": seconds_left, "goodness": goodness}
