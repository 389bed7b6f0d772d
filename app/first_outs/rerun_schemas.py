"""What a re-run takes and gives."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.first_outs.account import PeakKept, TripKept
from app.first_outs.replay_schemas import Value, ValueChanged, ValuePath
from app.runs.schemas import RunSamples

SHOWN = (
    *("force_n", "force_command_n", "valve_command"),
    *("displacement_m", "velocity_m_s", "supply_pressure_pa"),
)
ChannelName = Annotated[str, Field(max_length=50)]


class Change(BaseModel):
    """One value, by a path such as `controller.k_p` or `interlocks.force_error.threshold`."""

    model_config = ConfigDict(extra="forbid")

    path: ValuePath
    value: Value


class RerunAsked(BaseModel):
    """What to change, which channels to see in how many stretches, and how long to wait for it."""

    model_config = ConfigDict(extra="forbid")

    change: Change
    channels: Annotated[tuple[ChannelName, ...], Field(min_length=1, max_length=30)] = SHOWN
    points: Annotated[int, Field(ge=1, le=20_000)] = 2000
    wait_s: Annotated[float, Field(ge=0, le=60)] = 10.0


class CourseOut(BaseModel):
    """One course of what happened: times are seconds from the tick of the recorded first-out."""

    trips: list[TripKept]
    first_out: TripKept | None
    peaks: list[PeakKept]
    samples: RunSamples | None


class RerunOut(BaseModel):
    """As recorded, and on the virtual rig without and with the change.

    `lead_s` is how long before the first-out the re-run began; `text` says what the change did.
    """

    change: ValueChanged
    recorded: CourseOut
    unchanged: CourseOut
    changed: CourseOut
    lead_s: float
    from_the_beginning: bool
    not_rerun: list[str]
    text: list[str]
