"""An audit with its files, on a database of either kind."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from app.audit.service import Audit
from app.db import Database


@pytest.fixture
def audit(database: Database, tmp_path: Path) -> Iterator[Audit]:
    """One that is open, as in a console."""
    opened = Audit(database, tmp_path)
    opened.open()
    yield opened
    opened.close()
