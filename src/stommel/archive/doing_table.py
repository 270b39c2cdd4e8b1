"""The table of what people changed at a vehicle and no other table tells; `schema` has it too."""

from sqlalchemy import BigInteger, Column, Index, Table

from stommel.archive.columns import metadata, number_column, vehicle_column
from stommel.archive.wording import Name, Words

doings = Table(
    "doings",
    metadata,
    number_column(),
    vehicle_column(),
    Column("t_us", BigInteger, nullable=False),
    Column("kind", Name, nullable=False),  # hold or limit
    Column("user", Name, nullable=False),
    Column("words", Words, nullable=False),
    Index("ix_doings_vehicle_id_t_us", "vehicle_id", "t_us"),
)
"""By the vehicle's clock, as the log book tells it; the audit log has the same by the station's."""
