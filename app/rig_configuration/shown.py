"""Rig configurations as requests give them."""

from datetime import UTC, datetime

from app.revisions.kind import Revision
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.due import calibration_states
from app.rig_configuration.schemas import RigConfigurationOut, RigConfigurationRevisionOut


def in_force(revision: Revision[RigConfiguration], *, in_loop: bool) -> RigConfigurationOut:
    """The newest revision, and whether its calibrations hold today."""
    today = datetime.now(UTC).date()
    return RigConfigurationOut(
        revision=revision.number,
        author=revision.author,
        why=revision.why,
        created_at=revision.created_at,
        in_loop=in_loop,
        document=revision.document,
        calibrations=calibration_states(revision.document.calibrations, today),
    )


def revision(found: Revision[RigConfiguration]) -> RigConfigurationRevisionOut:
    """A revision with its document."""
    return RigConfigurationRevisionOut.model_validate(found, from_attributes=True)
