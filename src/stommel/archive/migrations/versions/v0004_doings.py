"""What people changed at a vehicle and no other table tells: who took command, who set which limit."""

import sqlalchemy as sa
from alembic import op

revision = "stommel_0004"
down_revision = "stommel_0003"
branch_labels = None
depends_on = None

_NUMBER = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Add the table; of before, the audit log knows."""
    op.create_table(
        "doings",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("kind", sa.String(), nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_doings_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_doings"),
    )
    op.create_index("ix_doings_vehicle_id_t_us", "doings", ["vehicle_id", "t_us"])
