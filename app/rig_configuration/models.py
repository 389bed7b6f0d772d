"""The revisions of the rig configuration."""

from app.db import Base
from app.revisions.models import RevisionRow


class RigConfigurationRevision(RevisionRow, Base):
    """A rig configuration as it was once adopted."""

    __tablename__ = "rig_configuration_revisions"
