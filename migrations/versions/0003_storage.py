"""The rule by which samples of old runs are removed, and when those of a run were."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None

BIG = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    op.create_table(
        "retention",
        sa.Column("id", sa.Integer, primary_key=True),
        sa.Column("revision", sa.Integer, nullable=False),
        sa.Column("keep_days", sa.Double),
        sa.Column("keep_bytes", BIG),
        sa.Column("keep_tags", sa.JSON, nullable=False),
        sa.Column("applied_at", sa.DateTime),
    )
    op.add_column("runs", sa.Column("samples_removed_at", sa.DateTime))
    op.create_index("runs_samples_removed", "runs", ["samples_removed_at"])


def downgrade() -> None:
    op.drop_index("runs_samples_removed", "runs")
    op.drop_column("runs", "samples_removed_at")
    op.drop_table("retention")
