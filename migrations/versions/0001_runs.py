"""Runs and what the loop reported of them."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "runs",
        sa.Column("id", sa.Integer, primary_key=True),
        sa.Column("test_id", sa.String(100), nullable=False),
        sa.Column("test_name", sa.String(200), nullable=False),
        sa.Column("definition", sa.JSON, nullable=False),
        sa.Column("plan", sa.JSON, nullable=False),
        sa.Column("controller", sa.JSON, nullable=False),
        sa.Column("interlocks", sa.JSON, nullable=False),
        sa.Column("rig", sa.JSON, nullable=False),
        sa.Column("conditions", sa.JSON, nullable=False),
        sa.Column("software_version", sa.String(50), nullable=False),
        sa.Column("loop_life", sa.String(50), nullable=False),
        sa.Column("period_ns", sa.Integer, nullable=False),
        sa.Column("started_at", sa.DateTime, nullable=False),
        sa.Column("ended_at", sa.DateTime),
        sa.Column("first_tick", sa.Integer),
        sa.Column("last_tick", sa.Integer),
        sa.Column("ticks", sa.Integer, nullable=False),
        sa.Column("missing_ticks", sa.Integer, nullable=False),
        sa.Column("outcome", sa.String(20)),
        sa.Column("verdict", sa.String(10), nullable=False),
        sa.Column("reason", sa.String(500)),
        sqlite_autoincrement=True,
    )
    op.create_index("runs_open", "runs", ["outcome"], sqlite_where=sa.text("outcome IS NULL"))
    op.create_table(
        "run_events",
        sa.Column(
            "run_id", sa.Integer, sa.ForeignKey("runs.id", ondelete="CASCADE"), nullable=False
        ),
        sa.Column("sequence", sa.Integer, nullable=False),
        sa.Column("tick", sa.Integer, nullable=False),
        sa.Column("kind", sa.String(30), nullable=False),
        sa.Column("code", sa.String(50), nullable=False),
        sa.Column("text", sa.String(500), nullable=False),
        sa.Column("value", sa.Double),
        sa.Column("limit", sa.Double),
        sa.PrimaryKeyConstraint("run_id", "sequence"),
    )


def downgrade() -> None:
    op.drop_table("run_events")
    op.drop_table("runs")
