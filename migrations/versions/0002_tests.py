"""Tests with revisions, frozen documents by content, what people note of runs, measurements, search."""

from collections.abc import Iterator
from typing import Any

import sqlalchemy as sa
from alembic import op
from sqlalchemy.engine import Row

from app.documents.canonical import fingerprint
from app.runs.words import facet, words_of

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def _key_text(length: int) -> Any:
    """Text in the order of its characters' numbers, in whatever language the server sorts."""
    return sa.String(length).with_variant(sa.String(length, collation="C"), "postgresql")


BIG = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
FROZEN = ("definition", "plan", "controller", "interlocks", "rig", "conditions")
FACETS = ("test_id", "outcome", "verdict")
PAGE = 500  # runs that are moved at a time

BEFORE = sa.table(
    "runs",
    *(sa.column(name, sa.JSON) for name in FROZEN),
    *(sa.column(name) for name in ("id", "test_id", "test_name", "reason")),
    *(sa.column(name) for name in ("outcome", "verdict", "ticks", "period_ns")),
)
AFTER = sa.table(
    "runs",
    *(sa.column(f"{name}_id") for name in FROZEN),
    *(sa.column(name) for name in ("id", "words", "duration_s")),
)
DOCUMENTS = sa.table("documents", sa.column("id"), sa.column("hash"), sa.column("body", sa.JSON))
WIDER = {
    "runs": ("id", "period_ns", "first_tick", "last_tick", "ticks", "missing_ticks"),
    "run_events": ("run_id", "sequence", "tick"),
}
NEW: dict[str, tuple[Any, str | None]] = {  # type, and what the rows have that are there already
    "revision": (sa.Integer, None),
    "prediction_verdict": (sa.String(10), None),
    "override_reason": (sa.String(500), None),
    "duration_s": (sa.Double, None),
    "operator": (_key_text(100), ""),
    "notes": (sa.Text, ""),
    "annotation": (sa.Integer, "0"),
    "words": (sa.Text, ""),
}
REFERENCES = (*FROZEN, "prediction")
INDICES = {
    "runs_of_test": ["test_id", "started_at"],
    "runs_started": ["started_at"],
    "runs_operator": ["operator"],
}


def upgrade() -> None:
    _make_tables()
    _widen()
    for name, (kind, before) in NEW.items():
        needed = before is not None
        op.add_column("runs", sa.Column(name, kind, nullable=not needed, server_default=before))
    for name in REFERENCES:
        op.add_column("runs", sa.Column(f"{name}_id", BIG))
    _freeze()
    with _rebuilt("runs") as batch:
        for name in FROZEN:
            batch.drop_column(name)
            batch.alter_column(f"{name}_id", existing_type=BIG, nullable=False)
        for name in REFERENCES:
            batch.create_foreign_key(f"runs_{name}", "documents", [f"{name}_id"], ["id"])
    for name, columns in INDICES.items():
        op.create_index(name, "runs", columns)
    _SEARCH[op.get_bind().dialect.name]()


def downgrade() -> None:
    _NO_SEARCH[op.get_bind().dialect.name]()
    for name in INDICES:
        op.drop_index(name, "runs")
    for name in FROZEN:
        op.add_column("runs", sa.Column(name, sa.JSON))
    _thaw()
    with _rebuilt("runs") as batch:
        for name in REFERENCES:
            batch.drop_constraint(f"runs_{name}", type_="foreignkey")
            batch.drop_column(f"{name}_id")
        for name in NEW:
            batch.drop_column(name)
        for name in FROZEN:
            batch.alter_column(name, existing_type=sa.JSON(), nullable=False)
    names = ("run_criteria", "run_measurements", "run_tags", "documents")
    for table in (*names, "test_revisions", "test_tags", "tests"):
        op.drop_table(table)


# ---- tables ----


def _make_tables() -> None:
    _make_tests()
    op.create_table(
        "documents",
        sa.Column("id", BIG, primary_key=True),
        sa.Column("hash", sa.String(64), nullable=False, unique=True),
        sa.Column("body", sa.JSON, nullable=False),
    )
    op.create_table(
        "run_tags",
        _of("runs.id", "run_id", BIG),
        sa.Column("tag", _key_text(50), primary_key=True),
    )
    op.create_index("run_tags_by_tag", "run_tags", ["tag", "run_id"])
    op.create_table(
        "run_measurements",
        _of("runs.id", "run_id", BIG),
        sa.Column("block", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("name", sa.String(50), primary_key=True),
        *_measured(),
        sa.Column("outcome", sa.String(10)),
    )
    op.create_table(
        "run_criteria",
        _of("runs.id", "run_id", BIG),
        sa.Column("position", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("measurement", sa.String(50), nullable=False),
        sa.Column("block", sa.Integer),
        *_measured(),
        sa.Column("outcome", sa.String(10), nullable=False),
    )


def _make_tests() -> None:
    op.create_table(
        "tests",
        sa.Column("id", _key_text(100), primary_key=True),
        sa.Column("name", sa.String(200), nullable=False),
        sa.Column("description", sa.Text, nullable=False),
        sa.Column("revision", sa.Integer, nullable=False),
        sa.Column("archived_at", sa.DateTime),
        sa.Column("created_at", sa.DateTime, nullable=False),
        sa.Column("updated_at", sa.DateTime, nullable=False),
    )
    op.create_table(
        "test_tags",
        _of("tests.id", "test_id", _key_text(100)),
        sa.Column("tag", _key_text(50), primary_key=True),
    )
    op.create_index("test_tags_by_tag", "test_tags", ["tag", "test_id"])
    op.create_table(
        "test_revisions",
        _of("tests.id", "test_id", _key_text(100)),
        sa.Column("number", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("definition", sa.JSON, nullable=False),
        sa.Column("yaml", sa.Text, nullable=False),
        sa.Column("content_hash", sa.String(64), nullable=False),
        sa.Column("author", sa.String(100), nullable=False),
        sa.Column("comment", sa.String(500), nullable=False),
        sa.Column("created_at", sa.DateTime, nullable=False),
        sa.Column("duration_s", sa.Double, nullable=False),
        sa.Column("peak_force_n", sa.Double, nullable=False),
        sa.Column("block_count", sa.Integer, nullable=False),
    )


def _of(target: str, name: str, kind: Any) -> sa.Column[Any]:
    """A key that is part of the row's own, and goes with the row that it refers to."""
    reference = sa.ForeignKey(target, ondelete="CASCADE")
    return sa.Column(name, kind, reference, primary_key=True, autoincrement=False)


def _measured() -> list[sa.Column[Any]]:
    limits = [sa.Column(name, sa.Double) for name in ("value", "at_least", "at_most")]
    return [sa.Column("unit", sa.String(20), nullable=False), *limits]


def _widen() -> None:
    """Ticks outgrow 32 bits in six days; SQLite's integers have 64 already."""
    if op.get_bind().dialect.name != "postgresql":
        return
    for table, columns in WIDER.items():
        for name in columns:
            op.alter_column(table, name, type_=sa.BigInteger())
    op.execute("ALTER SEQUENCE runs_id_seq AS bigint")


class _rebuilt:  # noqa: N801  # reads as the function that it is
    """Batch alterations; SQLite makes the table anew, and must go on numbering where it was."""

    def __init__(self, table: str) -> None:
        self._table = table
        self._batch = op.batch_alter_table(table, table_kwargs={"sqlite_autoincrement": True})

    def __enter__(self) -> Any:
        self._last = self._last_number()
        return self._batch.__enter__()

    def __exit__(self, *raised: Any) -> None:
        self._batch.__exit__(*raised)
        if self._last is not None:
            names = {"name": self._table, "last": self._last}
            for statement in (
                "DELETE FROM sqlite_sequence WHERE name = :name",
                "INSERT INTO sqlite_sequence (name, seq) VALUES (:name, :last)",
            ):
                op.get_bind().execute(sa.text(statement), names)

    def _last_number(self) -> int | None:
        if op.get_bind().dialect.name != "sqlite":
            return None
        statement = sa.text("SELECT seq FROM sqlite_sequence WHERE name = :name")
        found = op.get_bind().execute(statement, {"name": self._table}).scalar()
        return None if found is None else int(found)


# ---- data ----


def _freeze() -> None:
    """Put each run's documents among all documents, once however many runs have the same."""
    known: dict[str, int] = {}
    for run in _rows(BEFORE):
        values: dict[str, Any] = {
            f"{name}_id": _document(known, getattr(run, name)) for name in FROZEN
        }
        if run.outcome is not None:
            values["duration_s"] = run.ticks * run.period_ns * 1e-9
        values["words"] = _words(run)
        op.get_bind().execute(sa.update(AFTER).where(AFTER.c.id == run.id).values(values))


def _document(known: dict[str, int], body: Any) -> int:
    key = fingerprint(body)
    if key not in known:
        connection = op.get_bind()
        connection.execute(sa.insert(DOCUMENTS).values(hash=key, body=body))
        query = sa.select(DOCUMENTS.c.id).where(DOCUMENTS.c.hash == key)
        known[key] = connection.execute(query).scalar_one()
    return known[key]


def _words(run: Row[Any]) -> str:
    texts = (run.test_name, run.test_id, run.reason or "")
    facets = ((name, getattr(run, name)) for name in FACETS)
    return " ".join([*words_of(texts), *(facet(name, value) for name, value in facets if value)])


def _thaw() -> None:
    """Give each run its own copies back."""
    for run in _rows(AFTER):
        bodies = {}
        for name in FROZEN:
            query = sa.select(DOCUMENTS.c.body).where(DOCUMENTS.c.id == getattr(run, f"{name}_id"))
            bodies[name] = op.get_bind().execute(query).scalar_one()
        op.get_bind().execute(sa.update(BEFORE).where(BEFORE.c.id == run.id).values(bodies))


def _rows(table: sa.TableClause) -> Iterator[Row[Any]]:
    """Every run, some at a time, by its number."""
    last = 0
    while True:
        query = sa.select(table).where(table.c.id > last).order_by(table.c.id).limit(PAGE)
        rows = op.get_bind().execute(query).all()
        yield from rows
        if len(rows) < PAGE:
            return
        last = rows[-1].id


# ---- search ----
# `words` (app.runs.words) holds letters and digits only; each database indexes them with the
# run's number beside them.


def _search_sqlite() -> None:
    op.execute(
        "CREATE VIRTUAL TABLE runs_words USING fts5(words, content='', columnsize=0, "
        "detail='none', tokenize='ascii', prefix='1 2 3 4 5 6 7 8')"
    )
    op.execute("INSERT INTO runs_words (rowid, words) SELECT id, words || ' ' || id FROM runs")
    gone = (
        "INSERT INTO runs_words (runs_words, rowid, words) "
        "VALUES ('delete', old.id, old.words || ' ' || old.id);"
    )
    come = "INSERT INTO runs_words (rowid, words) VALUES (new.id, new.words || ' ' || new.id);"
    changed = "WHEN old.words IS NOT new.words"
    for name, when, what in (
        ("runs_words_insert", "AFTER INSERT ON runs", come),
        ("runs_words_delete", "AFTER DELETE ON runs", gone),
        ("runs_words_update", f"AFTER UPDATE OF words ON runs {changed}", f"{gone} {come}"),
    ):
        op.execute(f"CREATE TRIGGER {name} {when} BEGIN {what} END")


def _search_postgresql() -> None:
    op.execute(
        "ALTER TABLE runs ADD COLUMN words_index tsvector GENERATED ALWAYS AS "
        "(array_to_tsvector(string_to_array(ltrim(words || ' ' || id::text), ' '))) STORED"
    )
    op.execute("CREATE INDEX runs_words ON runs USING gin (words_index)")


def _no_search_sqlite() -> None:
    for name in ("insert", "delete", "update"):
        op.execute(f"DROP TRIGGER runs_words_{name}")
    op.execute("DROP TABLE runs_words")


def _no_search_postgresql() -> None:
    op.execute("ALTER TABLE runs DROP COLUMN words_index")


_SEARCH = {"sqlite": _search_sqlite, "postgresql": _search_postgresql}
_NO_SEARCH = {"sqlite": _no_search_sqlite, "postgresql": _no_search_postgresql}
