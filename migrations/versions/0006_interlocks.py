"""Revisions of the interlocks, and what tripped first."""

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None

BIG = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    op.create_table(
        "interlocks_revisions",
        sa.Column("number", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("document", sa.JSON, nullable=False),
        sa.Column("author", sa.String(100), nullable=False),
        sa.Column("why", sa.String(500), nullable=False),
        sa.Column("created_at", sa.DateTime, nullable=False),
    )
    _create_first_outs()


def _create_first_outs() -> None:
    op.create_table(
        "first_outs",
        sa.Column("id", BIG, primary_key=True),
        sa.Column("loop_life", sa.String(50), nullable=False),
        sa.Column("tick", BIG, nullable=False),
        sa.Column("tripped_at", sa.DateTime, nullable=False),
        sa.Column("detector", sa.String(60), nullable=False),
        sa.Column("quantity", sa.String(40), nullable=False),
        sa.Column("action", sa.String(20), nullable=False),
        sa.Column("text", sa.String(500), nullable=False),
        sa.Column("value", sa.Double),
        sa.Column("limit", sa.Double),
        sa.Column("mode_before", sa.String(20)),
        sa.Column("run_id", BIG),
        sa.Column("period_ns", BIG, nullable=False),
        sa.Column("ticks", BIG, nullable=False),
        sa.Column("account", sa.JSON, nullable=False),
        sa.Column("note", sa.Text, nullable=False),
        sa.Column("cause", sa.String(200), nullable=False),
        sa.UniqueConstraint("loop_life", "tick"),
        sqlite_autoincrement=True,
    )
    op.create_index("first_outs_by_detector", "first_outs", ["detector", "id"])
    op.create_index("first_outs_by_run", "first_outs", ["run_id", "id"])
    op.create_index("first_outs_by_time", "first_outs", ["tripped_at"])
    op.create_table(
        "first_outs_known",
        sa.Column("loop_life", sa.String(50), primary_key=True),
        sa.Column("tick", BIG, nullable=False),
    )


def downgrade() -> None:
    op.drop_table("first_outs_known")
    op.drop_table("first_outs")
    op.drop_table("interlocks_revisions")
