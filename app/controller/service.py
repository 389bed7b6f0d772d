"""The controller settings in force and all before them."""

from app.controller.models import ControllerRevision
from app.controller.record import controller_from
from app.controller.settings import ControllerSettings
from app.revisions.book import RevisionBook
from app.revisions.kind import Kind

CONTROLLER = Kind(
    "controller settings",
    "controller.change",
    ControllerRevision,
    ControllerSettings,
    controller_from,
)
ControllerSettingsBook = RevisionBook[ControllerSettings]
