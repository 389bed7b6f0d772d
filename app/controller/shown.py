"""Controller settings as requests give them."""

from app.controller.presets import COMPENSATORS
from app.controller.schemas import ControllerOut, ControllerRevisionOut
from app.controller.settings import Compensator, ControllerSettings
from app.revisions.kind import Revision


def in_force(revision: Revision[ControllerSettings], *, in_loop: bool) -> ControllerOut:
    """The newest revision."""
    return ControllerOut(
        revision=revision.number,
        author=revision.author,
        why=revision.why,
        created_at=revision.created_at,
        in_loop=in_loop,
        document=revision.document,
        presets={name: Compensator.model_validate(c) for name, c in COMPENSATORS.items()},
    )


def revision(found: Revision[ControllerSettings]) -> ControllerRevisionOut:
    """A revision with its settings."""
    return ControllerRevisionOut.model_validate(found, from_attributes=True)
