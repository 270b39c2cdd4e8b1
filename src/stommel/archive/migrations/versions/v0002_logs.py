"""Logs of vehicles, what is from them, how many CTD samples each hour has, and the profiles that were found."""

import sqlalchemy as sa
from alembic import op

revision = "stommel_0002"
down_revision = "stommel_0001"
branch_labels = None
depends_on = None

_NUMBER = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Add them; what is there already came by radio."""
    op.add_column("ctd", sa.Column("log_id", _NUMBER))
    op.add_column("dives", sa.Column("log_id", _NUMBER))
    op.add_column("vehicles", sa.Column("ctd_changes", sa.BigInteger(), nullable=False, server_default="0"))
    op.add_column("vehicles", sa.Column("profiles_change", sa.BigInteger(), nullable=False, server_default="0"))
    _make_hours()
    _make_profiles()
    _make_logs()


def _make_hours() -> None:
    op.create_table(
        "ctd_hours",
        sa.Column("vehicle_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("hour", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("count", sa.BigInteger(), nullable=False),
        sa.Column("change", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("vehicle_id", "hour", name="pk_ctd_hours"),
        sqlite_with_rowid=False,
    )
    op.create_index("ix_ctd_hours_vehicle_id_change", "ctd_hours", ["vehicle_id", "change"])
    op.execute(
        "INSERT INTO ctd_hours (vehicle_id, hour, count, change)"
        " SELECT vehicle_id, t_us / 3600000000, count(*), 1 FROM ctd GROUP BY vehicle_id, t_us / 3600000000"
    )
    op.execute("UPDATE vehicles SET ctd_changes = 1")


def _make_profiles() -> None:
    op.create_table(
        "profiles",
        sa.Column("vehicle_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("first_us", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("last_us", sa.BigInteger(), nullable=False),
        sa.Column("turned_us", sa.BigInteger(), nullable=False),
        sa.Column("settled", sa.Boolean(), nullable=False),
        sa.Column("direction", sa.Integer(), nullable=False),
        sa.Column("samples", sa.BigInteger(), nullable=False),
        sa.Column("dive", sa.BigInteger()),
        *(sa.Column(name, sa.Double()) for name in ("latitude", "longitude", "least_depth_m", "greatest_depth_m")),
        sa.PrimaryKeyConstraint("vehicle_id", "first_us", name="pk_profiles"),
        sqlite_with_rowid=False,
    )


def _make_logs() -> None:
    op.create_table(
        "logs",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("sha256", sa.String(length=64), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("size", sa.BigInteger(), nullable=False),
        sa.Column("series", sa.String(), nullable=False),
        sa.Column("software", sa.String(), nullable=False),
        sa.Column("state", sa.String(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.Column("offset", sa.BigInteger(), nullable=False),
        sa.Column("records", sa.BigInteger(), nullable=False),
        sa.Column("samples", sa.BigInteger(), nullable=False),
        sa.Column("dives", sa.BigInteger(), nullable=False),
        sa.Column("begin_us", sa.BigInteger()),
        sa.Column("end_us", sa.BigInteger()),
        sa.Column("changed_us", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_logs_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_logs"),
        sa.UniqueConstraint("vehicle_id", "sha256", name="uq_logs_vehicle_id_sha256"),
    )
