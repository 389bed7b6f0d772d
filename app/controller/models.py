"""The revisions of the controller settings."""

from app.db import Base
from app.revisions.models import RevisionRow


class ControllerRevision(RevisionRow, Base):
    """Controller settings as they were once adopted."""

    __tablename__ = "controller_revisions"
