"""A catalogue on a database of either kind."""

from pathlib import Path

import pytest

from app.catalogue.exchange import Library
from app.catalogue.service import Catalogue
from app.catalogue.written import Reader
from app.db import Database
from app.histories.store import Store


@pytest.fixture
def reader(tmp_path: Path) -> Reader:
    return Reader(Store(tmp_path / "histories"))


@pytest.fixture
def catalogue(database: Database, reader: Reader) -> Catalogue:
    return Catalogue(database, reader)


@pytest.fixture
def library(database: Database, reader: Reader) -> Library:
    return Library(database, reader)
