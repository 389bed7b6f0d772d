"""The rig configuration in force and all before it."""

from app.revisions.book import RevisionBook
from app.revisions.kind import Kind
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.models import RigConfigurationRevision
from app.rig_configuration.record import configuration_from

RIG_CONFIGURATION = Kind(
    "rig configuration",
    "rig_configuration.change",
    RigConfigurationRevision,
    RigConfiguration,
    configuration_from,
    verb="has",
)
RigConfigurations = RevisionBook[RigConfiguration]
