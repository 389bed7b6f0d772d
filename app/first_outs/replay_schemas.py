"""What a replay takes and gives."""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from app.first_outs.account import TripKept

ValuePath = Annotated[str, Field(min_length=1, max_length=200)]
Value = bool | int | float | str | list[str] | None


class ReplayAsked(BaseModel):
    """Values of detectors to change, by paths such as `force_error.threshold`."""

    model_config = ConfigDict(extra="forbid")

    interlocks: Annotated[dict[ValuePath, Value], Field(max_length=20)] = {}


class ValueChanged(BaseModel):
    """A value by its path, as it was and as it is now."""

    path: str
    before: Any
    value: Any


class NotReplayed(BaseModel):
    """A detector whose quantity the recording does not tell; its recorded trips stand."""

    detector: str
    why: str


class ReplayOut(BaseModel):
    """What trips over the recorded ticks; `first_out` is that of the changed table, null where the rig goes on.

    `reproduces` is whether the unchanged table trips exactly as the loop did.
    """

    recorded: list[TripKept]
    unchanged: list[TripKept]
    changed: list[TripKept]
    first_out: TripKept | None
    reproduces: bool
    changes: list[ValueChanged]
    not_replayed: list[NotReplayed]
    text: str
