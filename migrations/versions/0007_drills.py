"""Drills, and how they were scored."""

import sqlalchemy as sa
from alembic import op

revision = "0007"
down_revision = "0006"
branch_labels = None
depends_on = None


BIG = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    op.create_table(
        "drills",
        sa.Column("id", BIG, primary_key=True),
        sa.Column("fault", sa.String(40), nullable=False),
        sa.Column("amount", sa.Double, nullable=False),
        sa.Column("state", sa.String(20), nullable=False),
        sa.Column("mode_before", sa.String(20), nullable=False),
        sa.Column("given_by", sa.String(200), nullable=False),
        sa.Column("given_at", sa.DateTime, nullable=False),
        sa.Column("ended_at", sa.DateTime),
        sa.Column("loop_life", sa.String(50), nullable=False),
        sa.Column("period_ns", BIG, nullable=False),
        sa.Column("tick", BIG),
        sa.Column("run_id", BIG),
        sa.Column("first_out", sa.String(60)),
        sa.Column("reaction_ticks", BIG),
        sa.Column("why", sa.String(500)),
        sa.Column("ticks", BIG, nullable=False),
        sa.Column("score", sa.JSON),
        sqlite_autoincrement=True,
    )
    op.create_index("drills_by_fault", "drills", ["fault", "id"])
    op.create_index("drills_by_state", "drills", ["state"])


def downgrade() -> None:
    op.drop_table("drills")
