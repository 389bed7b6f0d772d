"""The revisions of the table of detectors."""

from app.db import Base
from app.revisions.models import RevisionRow


class InterlocksRevision(RevisionRow, Base):
    """A table as it was once adopted."""

    __tablename__ = "interlocks_revisions"
