"""A desk for each test; hashing by one set of threads."""

from collections.abc import Iterator

import pytest

from app.access.passwords import Passwords
from app.db import Database
from tests.unit.app.access.at_a_time import Desk


@pytest.fixture(scope="session")
def passwords() -> Iterator[Passwords]:
    made = Passwords()
    made.open()
    yield made
    made.close()


@pytest.fixture
def desk(database: Database, passwords: Passwords) -> Iterator[Desk]:
    made = Desk(database, passwords)
    yield made
    made.identity.close()
