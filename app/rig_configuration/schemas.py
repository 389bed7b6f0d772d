"""What the requests about the rig configuration take and give."""

from datetime import datetime

from pydantic import BaseModel

from app.revisions.schemas import SettingsRevision
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.due import CalibrationState


class RigConfigurationOut(BaseModel):
    """The configuration in force. `in_loop` is whether the loop's twin is of its model."""

    revision: int
    author: str
    why: str
    created_at: datetime
    in_loop: bool
    document: RigConfiguration
    calibrations: list[CalibrationState]


class RigConfigurationRevisionOut(SettingsRevision):
    """With its document. Number 0 is the one as shipped."""

    document: RigConfiguration
