"""What the requests about the scene take and give."""

from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

VIEW_NAME = r"^[A-Za-z0-9-]{0,64}$"
ViewName = Annotated[str, Field(pattern=VIEW_NAME, description="which view, chosen by its page")]
Times = Annotated[float, Field(ge=1, le=100, allow_inf_nan=False)]


class SceneState(StrEnum):
    """What the scene's process is doing."""

    IDLE = "idle"  # nobody looks: it does not run
    STARTING = "starting"
    READY = "ready"
    WAITING = "waiting"  # it has ended, and starts again in a moment


class Scale(BaseModel):
    """The colours of a quantity, evenly from one end to the other."""

    from_value: float
    to_value: float
    unit: str
    colours: list[str]


class SceneOut(BaseModel):
    """The scene as it is. `life` counts its processes: a page loads the view again when it changes."""

    state: SceneState
    life: int
    detail: str
    viewers: int
    pressure: Scale
    force: Scale


class SceneCursor(BaseModel):
    """What a view of the caller's own shows: a moment of a run (s from its first tick), or the rig now."""

    model_config = ConfigDict(extra="forbid")

    view: ViewName = ""
    run_id: Annotated[int, Field(ge=1, le=2**53)] | None = None
    time_s: Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)] | None = None
    deformation: Times = 50.0
    travel: Annotated[float, Field(ge=1, le=3, allow_inf_nan=False)] = 1.0
