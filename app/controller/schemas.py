"""What the requests about the controller settings take and give."""

from datetime import datetime

from pydantic import BaseModel

from app.controller.settings import Compensator, ControllerSettings
from app.revisions.schemas import SettingsRevision


class ControllerOut(BaseModel):
    """The settings in force. `in_loop` is whether the loop works with them, `presets` the compensators by name."""

    revision: int
    author: str
    why: str
    created_at: datetime
    in_loop: bool
    document: ControllerSettings
    presets: dict[str, Compensator]


class ControllerRevisionOut(SettingsRevision):
    """With its settings. Number 0 is the one as shipped."""

    document: ControllerSettings
