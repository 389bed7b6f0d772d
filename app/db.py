"""The database: what people write and decide. Samples never go in here.

One transaction a request: `reading()` and `writing()` each give a session for exactly one.
"""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sqlalchemy import (
    BigInteger,
    Connection,
    DateTime,
    Dialect,
    Engine,
    Integer,
    String,
    TypeDecorator,
    create_engine,
    event,
    make_url,
)
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import DeclarativeBase, Session, sessionmaker
from sqlalchemy.types import TypeEngine

from app.settings import Settings

if TYPE_CHECKING:
    from alembic.config import Config

BUSY_TIMEOUT_MS = 15_000
NO_NUL = r"^[^\x00]*$"  # PostgreSQL keeps every character but this
_PRAGMAS = (
    "PRAGMA journal_mode=WAL",
    "PRAGMA synchronous=FULL",  # an acknowledged commit survives a power cut
    "PRAGMA foreign_keys=ON",
    f"PRAGMA busy_timeout={BUSY_TIMEOUT_MS}",
)

_POSTGRESQL: dict[str, Any] = {
    "pool_pre_ping": True,  # the server may have been restarted
    "pool_size": 10,
    "connect_args": {
        "application_name": "forcerig",
        "connect_timeout": 10,
        "options": f"-c synchronous_commit=on -c lock_timeout={BUSY_TIMEOUT_MS}",
    },
}

# Ticks outgrow 32 bits in six days. SQLite has integers of one kind, and numbers only INTEGER keys.
BigInt = BigInteger().with_variant(Integer(), "sqlite")


def key_text(length: int) -> TypeEngine[str]:
    """Text that is put in order by its characters' numbers, in whatever language a server sorts."""
    return String(length).with_variant(String(length, collation="C"), "postgresql")


class Base(DeclarativeBase):
    """What every table derives from."""


class UtcDateTime(TypeDecorator[datetime]):
    """An aware time, kept as UTC: SQLite itself knows no zones."""

    impl = DateTime
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        return None if value is None else value.astimezone(UTC).replace(tzinfo=None)

    def process_result_value(self, value: Any | None, dialect: Dialect) -> datetime | None:
        return None if value is None else value.replace(tzinfo=UTC)


def _prepare_sqlite(engine: Engine) -> None:
    @event.listens_for(engine, "connect")
    def _connected(connection: sqlite3.Connection, record: object) -> None:
        connection.isolation_level = None  # SQLAlchemy alone says when one begins
        for pragma in _PRAGMAS:
            connection.execute(pragma)

    @event.listens_for(engine, "begin")
    def _begun(connection: Any) -> None:
        # A transaction that reads first and writes later may fail at once: take the lock first.
        writes = connection.get_execution_options().get("writes", False)
        connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


class Database:
    """An engine with its connections prepared, and sessions on it: SQLite or PostgreSQL, by URL."""

    def __init__(self, url: str) -> None:
        address = make_url(url)
        sqlite = address.get_backend_name() == "sqlite"
        if not sqlite:
            address = address.set(drivername="postgresql+psycopg")
        self.engine = create_engine(address, **({} if sqlite else _POSTGRESQL))
        if sqlite:
            _prepare_sqlite(self.engine)
        self._reader = self.engine
        if not sqlite:
            self._reader = self.engine.execution_options(
                isolation_level="REPEATABLE READ", postgresql_readonly=True
            )
        self._writer = self.engine.execution_options(writes=True)
        self.writers = sessionmaker(self._writer, expire_on_commit=False)

    def upgrade(self, revision: str = "head") -> None:
        """Bring the tables to the newest revision; an interrupted one has changed nothing."""
        from alembic import command  # a third of a second to load, and a worker never migrates

        with self._rebuilding() as connection:
            command.upgrade(_alembic(connection), revision)

    def downgrade(self, revision: str) -> None:
        """Bring the tables back to an older revision."""
        from alembic import command

        with self._rebuilding() as connection:
            command.downgrade(_alembic(connection), revision)

    @contextmanager
    def _rebuilding(self) -> Iterator[Connection]:
        """A transaction in which tables may be made anew.

        SQLite does that by copying, and would take a table's rows with it out of those that refer
        to it: so it checks the references once, at the end.
        """
        with self._writer.connect() as connection:
            driver: Any = connection.connection.driver_connection
            sqlite = self.engine.dialect.name == "sqlite"
            if sqlite:
                driver.execute("PRAGMA foreign_keys=OFF")
            try:
                with connection.begin():
                    yield connection
                    if sqlite and connection.exec_driver_sql("PRAGMA foreign_key_check").first():
                        raise IntegrityError("PRAGMA foreign_key_check", None, ValueError())
            finally:
                if sqlite:
                    driver.execute("PRAGMA foreign_keys=ON")

    @contextmanager
    def reading(self) -> Iterator[Session]:
        """A session that only reads, all of it from one moment."""
        with Session(self._reader) as session:
            yield session

    @contextmanager
    def writing(self) -> Iterator[Session]:
        """A session that is committed at the end, or rolled back where it failed."""
        with self.writers.begin() as session:
            yield session

    def close(self) -> None:
        """Close every connection."""
        self.engine.dispose()


def upgrade(data_dir: Path) -> None:
    """Bring the database of a data directory to the newest revision."""
    data_dir.mkdir(parents=True, exist_ok=True)
    database = Database(Settings(data_dir=data_dir).database_address)
    database.upgrade()
    database.close()


def _alembic(connection: Connection) -> "Config":
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(migrations_folder()))
    config.attributes["connection"] = connection
    return config


def migrations_folder() -> Path:
    """In the repository they lie beside the package, in a wheel inside it."""
    inside = Path(__file__).parent / "migrations"
    return inside if inside.exists() else Path(__file__).parent.parent / "migrations"
