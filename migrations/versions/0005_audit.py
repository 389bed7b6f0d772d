"""The audit: who did what, when and why, in a chain."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"
branch_labels = None
depends_on = None

BIG = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
ONLY_ADDED_TO = "the audit is only ever added to"


def _key_text(length: int) -> sa.types.TypeEngine[str]:
    """Text in the order of its characters' numbers, in whatever language the server sorts."""
    return sa.String(length).with_variant(sa.String(length, collation="C"), "postgresql")


def upgrade() -> None:
    op.create_table(
        "audit",
        sa.Column("id", BIG, primary_key=True, autoincrement=False),
        sa.Column("at", _key_text(32), nullable=False),
        sa.Column("who", _key_text(200), nullable=False),
        sa.Column("role", sa.String(200), nullable=False),
        sa.Column("credential", sa.String(200), nullable=False),
        sa.Column("action", _key_text(200), nullable=False),
        sa.Column("target", _key_text(200), nullable=False),
        sa.Column("why", sa.Text),
        sa.Column("before", sa.Text),
        sa.Column("after", sa.Text),
        sa.Column("outcome", sa.String(200), nullable=False),
        sa.Column("key", sa.String(50), unique=True),
        sa.Column("previous_hash", sa.String(64), nullable=False),
        sa.Column("hash", sa.String(64), nullable=False),
        sa.Column("words", sa.Text, nullable=False),
    )
    for name, columns in {"at": ["at"], "who": ["who", "id"], "target": ["target", "id"]}.items():
        op.create_index(f"audit_{name}", "audit", columns)
    for statement in _TRIGGERS[op.get_bind().dialect.name]:
        op.execute(statement)


def downgrade() -> None:
    op.drop_table("audit")  # and its triggers with it
    if op.get_bind().dialect.name == "postgresql":
        op.execute("DROP FUNCTION audit_refuse()")


_SQLITE = (
    f"CREATE TRIGGER audit_never_changed BEFORE UPDATE ON audit "
    f"BEGIN SELECT RAISE(ABORT, '{ONLY_ADDED_TO}'); END",
    f"CREATE TRIGGER audit_never_removed BEFORE DELETE ON audit "
    f"BEGIN SELECT RAISE(ABORT, '{ONLY_ADDED_TO}'); END",
    # INSERT OR REPLACE removes without asking the trigger above.
    f"CREATE TRIGGER audit_never_replaced BEFORE INSERT ON audit "
    f"WHEN EXISTS (SELECT 1 FROM audit WHERE id = NEW.id OR key = NEW.key) "
    f"BEGIN SELECT RAISE(ABORT, '{ONLY_ADDED_TO}'); END",
)
_POSTGRESQL = (
    f"CREATE FUNCTION audit_refuse() RETURNS trigger LANGUAGE plpgsql AS "
    f"$$BEGIN RAISE EXCEPTION '{ONLY_ADDED_TO}'; END$$",
    "CREATE TRIGGER audit_never_changed BEFORE UPDATE OR DELETE ON audit "
    "FOR EACH ROW EXECUTE FUNCTION audit_refuse()",
    "CREATE TRIGGER audit_never_emptied BEFORE TRUNCATE ON audit "
    "FOR EACH STATEMENT EXECUTE FUNCTION audit_refuse()",
)
_TRIGGERS = {"sqlite": _SQLITE, "postgresql": _POSTGRESQL}
