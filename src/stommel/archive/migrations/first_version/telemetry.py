"""Tables of the first version for what vehicles send, as they were then."""

import sqlalchemy as sa
from alembic import op

_NUMBER = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def make_telemetry() -> None:
    """Make them."""
    _make_vehicles()
    _make_channels()
    _make_frames()
    _make_samples()
    _make_texts()
    _make_dives()
    _make_ctd()
    _make_cells("minutes", "minute")
    _make_cells("ten_minutes", "ten")


def _make_vehicles() -> None:
    op.create_table(
        "vehicles",
        sa.Column("id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("model", sa.String(), nullable=False),
        sa.Column("added_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_vehicles"),
    )


def _make_channels() -> None:
    op.create_table(
        "channels",
        sa.Column("id", sa.Integer(), autoincrement=True, nullable=False),
        sa.Column("key", sa.String(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_channels"),
        sa.UniqueConstraint("key", name="uq_channels_key"),
    )


def _make_frames() -> None:
    op.create_table(
        "frames",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("received_us", sa.BigInteger(), nullable=False),
        sa.Column("direction", sa.String(length=3), nullable=False),
        sa.Column("system", sa.Integer(), nullable=False),
        sa.Column("component", sa.Integer(), nullable=False),
        sa.Column("message_id", sa.Integer(), nullable=False),
        sa.Column("sequence", sa.Integer(), nullable=False),
        sa.Column("signed", sa.Boolean(), nullable=False),
        sa.Column("frame", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_frames_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_frames"),
    )
    op.create_index("ix_frames_vehicle_id_id", "frames", ["vehicle_id", "id"])
    op.create_index("ix_frames_vehicle_id_message_id_id", "frames", ["vehicle_id", "message_id", "id"])
    op.create_index("ix_frames_vehicle_id_t_us", "frames", ["vehicle_id", "t_us"])


def _make_samples() -> None:
    op.create_table(
        "samples",
        sa.Column("vehicle_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("channel_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("t_us", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("value", sa.Double(), nullable=False),
        sa.PrimaryKeyConstraint("vehicle_id", "channel_id", "t_us", name="pk_samples"),
        sqlite_with_rowid=False,
    )


def _make_texts() -> None:
    op.create_table(
        "texts",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("severity", sa.Integer(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_texts_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_texts"),
    )
    op.create_index("ix_texts_vehicle_id_t_us", "texts", ["vehicle_id", "t_us"])


def _make_dives() -> None:
    op.create_table(
        "dives",
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("dive", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("t_begin_us", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("t_end_us", sa.BigInteger()),
        sa.Column("latitude_begin", sa.Double()),
        sa.Column("longitude_begin", sa.Double()),
        sa.Column("latitude_end", sa.Double()),
        sa.Column("longitude_end", sa.Double()),
        sa.Column("greatest_depth_m", sa.Double()),
        sa.Column("current_north_m_s", sa.Double()),
        sa.Column("current_east_m_s", sa.Double()),
        sa.Column("energy_j", sa.Double()),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_dives_vehicle_id"),
        sa.PrimaryKeyConstraint("vehicle_id", "dive", "t_begin_us", name="pk_dives"),
    )


def _make_ctd() -> None:
    op.create_table(
        "ctd",
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("dive", sa.BigInteger()),
        sa.Column("pressure_dbar", sa.Double()),
        sa.Column("temperature_degc", sa.Double()),
        sa.Column("conductivity_s_m", sa.Double()),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_ctd_vehicle_id"),
        sa.PrimaryKeyConstraint("vehicle_id", "t_us", name="pk_ctd"),
        sqlite_with_rowid=False,
    )


def _make_cells(name: str, number: str) -> None:
    op.create_table(
        name,
        sa.Column("vehicle_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("channel_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column(number, sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("count", sa.BigInteger(), nullable=False),
        sa.Column("total", sa.Double(), nullable=False),
        sa.Column("first_t_us", sa.BigInteger(), nullable=False),
        sa.Column("first", sa.Double(), nullable=False),
        sa.Column("last_t_us", sa.BigInteger(), nullable=False),
        sa.Column("last", sa.Double(), nullable=False),
        sa.Column("low_t_us", sa.BigInteger(), nullable=False),
        sa.Column("low", sa.Double(), nullable=False),
        sa.Column("high_t_us", sa.BigInteger(), nullable=False),
        sa.Column("high", sa.Double(), nullable=False),
        sa.PrimaryKeyConstraint("vehicle_id", "channel_id", number, name=f"pk_{name}"),
        sqlite_with_rowid=False,
    )
