"""Identifications, and what came of them."""

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"
branch_labels = None
depends_on = None


BIG = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    op.create_table(
        "identifications",
        sa.Column("id", BIG, primary_key=True),
        sa.Column("state", sa.String(20), nullable=False),
        sa.Column("run_ids", sa.JSON, nullable=False),
        sa.Column("fit", sa.JSON, nullable=False),
        sa.Column("based_on", sa.Integer, nullable=False),
        sa.Column("model", sa.JSON, nullable=False),
        sa.Column("author", sa.String(200), nullable=False),
        sa.Column("created_at", sa.DateTime, nullable=False),
        sa.Column("ended_at", sa.DateTime),
        sa.Column("reason", sa.String(500)),
        sa.Column("result", sa.JSON),
        sa.Column("adopted_revision", sa.Integer),
        sqlite_autoincrement=True,
    )
    op.create_index("identifications_by_state", "identifications", ["state"])


def downgrade() -> None:
    op.drop_table("identifications")
