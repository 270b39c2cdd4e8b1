"""Tables for logs that were taken in, and for what was found among the CTD samples; `schema` has them too."""

from sqlalchemy import BigInteger, Boolean, Column, Double, Index, Integer, String, Table, UniqueConstraint

from stommel.archive.columns import metadata, number_column, vehicle_column
from stommel.archive.wording import Name, Words

ctd_hours = Table(
    "ctd_hours",
    metadata,
    Column("vehicle_id", Integer, primary_key=True, autoincrement=False),
    Column("hour", BigInteger, primary_key=True, autoincrement=False),  # since 1970
    Column("count", BigInteger, nullable=False),
    Column("change", BigInteger, nullable=False),  # of vehicles.ctd_changes, that touched it last
    Index("ix_ctd_hours_vehicle_id_change", "vehicle_id", "change"),
    sqlite_with_rowid=False,
)
"""How many CTD samples each hour has; whoever knows them up to a change reads what has changed since alone."""

profiles = Table(
    "profiles",
    metadata,
    Column("vehicle_id", Integer, primary_key=True, autoincrement=False),
    Column("first_us", BigInteger, primary_key=True, autoincrement=False),
    Column("last_us", BigInteger, nullable=False),
    Column("turned_us", BigInteger, nullable=False),  # the turning point before
    Column("settled", Boolean, nullable=False),  # whether no later sample can change it
    Column("direction", Integer, nullable=False),  # 1 down, -1 up
    Column("samples", BigInteger, nullable=False),
    Column("dive", BigInteger),
    Column("latitude", Double),
    Column("longitude", Double),
    Column("least_depth_m", Double),
    Column("greatest_depth_m", Double),
    sqlite_with_rowid=False,
)
"""What was found in the CTD samples, so that it is not sought again after a restart; it may be emptied at any time."""

logs = Table(
    "logs",
    metadata,
    number_column(),
    vehicle_column(),
    Column("sha256", String(64), nullable=False),
    Column("name", Name, nullable=False),
    Column("size", BigInteger, nullable=False),
    Column("series", Name, nullable=False),  # as its header says
    Column("software", Name, nullable=False),
    Column("state", Name, nullable=False),  # going, taken or refused
    Column("words", Words, nullable=False),  # whether it was whole; why it was refused
    Column("offset", BigInteger, nullable=False),  # up to where it is in the archive [byte]
    Column("records", BigInteger, nullable=False),
    Column("samples", BigInteger, nullable=False),
    Column("dives", BigInteger, nullable=False),
    Column("begin_us", BigInteger),
    Column("end_us", BigInteger),
    Column("changed_us", BigInteger, nullable=False),  # by the station's clock
    Column("texts", BigInteger, nullable=False, server_default="0"),
    Column("left_out", BigInteger, nullable=False, server_default="0"),  # rows that no archive takes
    UniqueConstraint("vehicle_id", "sha256"),
)
"""Files of vehicles' logs that were taken in, each once by its content; telemetry from begin to end is from it too."""
