"""Texts that are from a log, and what each log brought of them; rows of a log that no archive takes."""

import sqlalchemy as sa
from alembic import op

revision = "stommel_0003"
down_revision = "stommel_0002"
branch_labels = None
depends_on = None

_NUMBER = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Add them; what is there already came by radio."""
    op.add_column("texts", sa.Column("log_id", _NUMBER))
    for name in ("texts", "left_out"):
        op.add_column("logs", sa.Column(name, sa.BigInteger(), nullable=False, server_default="0"))
