"""What all tests share: no deadlines for property tests, and databases of both kinds."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from app.db import Database
from tests.console_process import OF_FOLDER
from tests.postgres import Server, programs, serving

# Compiling and noisy machines break any deadline. The same code is asked the same each time; who looks for what
# nobody has thought of yet draws anew: `pytest --hypothesis-profile wandering`.
settings.register_profile("forcerig", deadline=None, derandomize=True)
settings.register_profile("wandering", deadline=None)
settings.load_profile("forcerig")

HERE = Path(__file__).parent
ON_POSTGRESQL = pytest.param("postgresql", marks=[pytest.mark.process, pytest.mark.slow])


@pytest.hookimpl(tryfirst=True)  # before -m selects by it
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Real processes and browsers have the machine to themselves; everything else may run side by side."""
    for item in items:
        beside = item.path.relative_to(HERE).parts[0] in ("unit", "scenarios")
        if not beside or item.get_closest_marker("process") or item.get_closest_marker("browser"):
            item.add_marker(pytest.mark.alone)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> Iterator[None]:
    """A folder's console ends with its last test: its loop would take a fifth of a processor from all others."""
    yield
    folder = item.path.parent
    if folder in OF_FOLDER and (nextitem is None or nextitem.path.parent != folder):
        OF_FOLDER.pop(folder).clean_up()


def pytest_addoption(parser: pytest.Parser) -> None:
    """`pytest tests/api --database postgresql`: the whole interface on a server of its own."""
    kinds = ("sqlite", "postgresql")
    parser.addoption("--database", choices=kinds, default="sqlite", help="of the tests' console")


@pytest.fixture(scope="session")
def postgres() -> Iterator[Server]:
    folder = programs()
    if folder is None:
        pytest.skip("there is no PostgreSQL server here (apt-get install postgresql)")
    with serving(folder) as server:
        yield server


@pytest.fixture(scope="session")
def migrated_template(postgres: Server) -> str:
    """A database with its tables, to copy."""
    name = postgres.new_database()
    database = Database(postgres.url(name))
    database.upgrade()
    database.close()
    return name


@pytest.fixture(params=["sqlite", ON_POSTGRESQL])
def empty_database(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Database]:
    """A database without tables, of either kind."""
    if request.param == "sqlite":
        url = f"sqlite:///{tmp_path / 'test.sqlite'}"
    else:
        server: Server = request.getfixturevalue("postgres")
        url = server.url(server.new_database())
    database = Database(url)
    yield database
    database.close()


@pytest.fixture(params=["sqlite", ON_POSTGRESQL])
def database(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Database]:
    """A database with its tables, of either kind."""
    if request.param == "sqlite":
        made = Database(f"sqlite:///{tmp_path / 'test.sqlite'}")
        made.upgrade()
    else:
        server: Server = request.getfixturevalue("postgres")
        template = request.getfixturevalue("migrated_template")
        made = Database(server.url(server.new_database(template)))
    yield made
    made.close()
