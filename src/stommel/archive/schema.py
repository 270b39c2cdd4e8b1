"""The tables of the archive, for SQLite and PostgreSQL alike.

Times named `..._us` are whole microseconds since 1970 of the vehicle's clock, `received_us` that of the station's.
Whoever changes a table here changes it in a migration too; a test compares both.
"""

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    String,
    Table,
)

from stommel.archive.columns import NUMBER, metadata, number_column, value_columns, vehicle_column
from stommel.archive.doing_table import doings
from stommel.archive.log_tables import ctd_hours, logs, profiles
from stommel.archive.wording import Name, Words

OTHER_TABLES = (ctd_hours, doings, logs, profiles)
"""Tables that have a file of their own."""

vehicles = Table(
    "vehicles",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=False),  # its system number on the link
    Column("name", Name, nullable=False),
    Column("model", Name, nullable=False),  # name of its vehicle file, or ""
    Column("added_us", BigInteger, nullable=False),
    Column("ctd_changes", BigInteger, nullable=False, server_default="0"),  # how often its CTD samples have changed
    Column("profiles_change", BigInteger, nullable=False, server_default="0"),  # up to which `profiles` are known
)

frames = Table(
    "frames",
    metadata,
    number_column(),
    vehicle_column(),
    Column("t_us", BigInteger, nullable=False),
    Column("received_us", BigInteger, nullable=False),
    Column("direction", String(3), nullable=False),  # 'in' or 'out', seen from the station
    Column("system", Integer, nullable=False),
    Column("component", Integer, nullable=False),
    Column("message_id", Integer, nullable=False),
    Column("sequence", Integer, nullable=False),
    Column("signed", Boolean, nullable=False),
    Column("frame", LargeBinary, nullable=False),
    Index("ix_frames_vehicle_id_t_us", "vehicle_id", "t_us"),
    Index("ix_frames_vehicle_id_message_id_id", "vehicle_id", "message_id", "id"),
    Index("ix_frames_vehicle_id_id", "vehicle_id", "id"),
)

channels = Table(
    "channels",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("key", Name, nullable=False, unique=True),
)

samples = Table(
    "samples",
    metadata,
    Column("vehicle_id", Integer, primary_key=True, autoincrement=False),
    Column("channel_id", Integer, primary_key=True, autoincrement=False),
    Column("t_us", BigInteger, primary_key=True, autoincrement=False),
    Column("value", Double, nullable=False),
    sqlite_with_rowid=False,
)
"""No foreign keys: `store` alone writes here, and each would be looked up thousands of times a second."""


def _cells(name: str, number: str) -> Table:
    """What the samples of a channel come to in each stretch of time; `number` counts these since 1970."""
    return Table(
        name,
        metadata,
        Column("vehicle_id", Integer, primary_key=True, autoincrement=False),
        Column("channel_id", Integer, primary_key=True, autoincrement=False),
        Column(number, BigInteger, primary_key=True, autoincrement=False),
        Column("count", BigInteger, nullable=False),
        Column("total", Double, nullable=False),
        Column("first_t_us", BigInteger, nullable=False),
        Column("first", Double, nullable=False),
        Column("last_t_us", BigInteger, nullable=False),
        Column("last", Double, nullable=False),
        Column("low_t_us", BigInteger, nullable=False),
        Column("low", Double, nullable=False),
        Column("high_t_us", BigInteger, nullable=False),
        Column("high", Double, nullable=False),
        sqlite_with_rowid=False,
    )


minutes = _cells("minutes", "minute")
ten_minutes = _cells("ten_minutes", "ten")

texts = Table(
    "texts",
    metadata,
    number_column(),
    vehicle_column(),
    Column("t_us", BigInteger, nullable=False),
    Column("severity", Integer, nullable=False),  # MAVLink's: 0 emergency ... 7 debug
    Column("words", Words, nullable=False),
    Column("log_id", NUMBER),  # of the log that it is from; none: it came by radio
    Index("ix_texts_vehicle_id_t_us", "vehicle_id", "t_us"),
)

dives = Table(
    "dives",
    metadata,
    vehicle_column(key=True),
    Column("dive", BigInteger, primary_key=True, autoincrement=False),
    Column("t_begin_us", BigInteger, primary_key=True, autoincrement=False),
    Column("t_end_us", BigInteger),
    *value_columns("latitude_begin", "longitude_begin", "latitude_end", "longitude_end", "greatest_depth_m"),
    *value_columns("current_north_m_s", "current_east_m_s", "energy_j"),
    Column("log_id", NUMBER),  # of the log that told of it; none: the radio alone
)

ctd = Table(
    "ctd",
    metadata,
    vehicle_column(key=True),
    Column("t_us", BigInteger, primary_key=True, autoincrement=False),
    Column("dive", BigInteger),
    Column("pressure_dbar", Double),
    Column("temperature_degc", Double),
    Column("conductivity_s_m", Double),
    Column("log_id", NUMBER),  # of the log that it is from; none: it came by radio
    sqlite_with_rowid=False,
)

commands = Table(
    "commands",
    metadata,
    Column("id", String(16), primary_key=True),  # 64 bits in hexadecimal
    vehicle_column(),
    Column("user", Name, nullable=False),
    Column("given_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger, nullable=False),
    Column("name", Name, nullable=False),
    Column("parameters", JSON, nullable=False),
    Column("occasion", Name, nullable=False),  # when it may be executed: at_once, at_next_surfacing, until_expiry
    Column("state", Name, nullable=False),
    Column("outcome", Words),
    Column("changed_us", BigInteger, nullable=False),
    Index("ix_commands_vehicle_id_given_us", "vehicle_id", "given_us"),
)

command_history = Table(
    "command_history",
    metadata,
    number_column(),
    Column("command_id", String(16), ForeignKey("commands.id"), nullable=False, index=True),
    Column("t_us", BigInteger, nullable=False),
    Column("state", Name, nullable=False),
    Column("words", Words),
)

parameters = Table(
    "parameters",
    metadata,
    number_column(),
    vehicle_column(),
    Column("component", Integer, nullable=False),
    Column("name", Name, nullable=False),
    Column("value", Double, nullable=False),
    Column("kind", Name, nullable=False),
    Column("t_us", BigInteger, nullable=False),
    Column("user", Name),
    Column("source", Name, nullable=False),  # 'vehicle' or 'written'
    Index("ix_parameters_vehicle_id_component_name_t_us", "vehicle_id", "component", "name", "t_us"),
)
"""History: the newest row of a name is what it is."""

parameter_writes = Table(
    "parameter_writes",
    metadata,
    number_column(),
    vehicle_column(),
    Column("component", Integer, nullable=False),
    Column("name", Name, nullable=False),
    Column("value", Double, nullable=False),
    Column("user", Name, nullable=False),
    Column("t_us", BigInteger, nullable=False),
    Column("state", Name, nullable=False),
    Column("words", Words, nullable=False),
    Column("holds", Double),
    Index("ix_parameter_writes_vehicle_id_id", "vehicle_id", "id"),
)
"""Values that people set, and what became of each."""

missions = Table(
    "missions",
    metadata,
    number_column(),
    vehicle_column(),
    Column("t_us", BigInteger, nullable=False),
    Column("user", Name),
    Column("name", Name, nullable=False),
    Column("sha256", String(64), nullable=False),
    Column("orders", Words, nullable=False),
    Column("plan", JSON(none_as_null=True)),
    Column("preview", JSON(none_as_null=True)),
    Column("state", Name, nullable=False),
    Column("until_us", BigInteger),  # until when it is tried, by the clock of the link
    Index("ix_missions_vehicle_id_t_us", "vehicle_id", "t_us"),
)

mission_history = Table(
    "mission_history",
    metadata,
    number_column(),
    Column("mission_id", NUMBER, ForeignKey("missions.id"), nullable=False, index=True),
    Column("t_us", BigInteger, nullable=False),
    Column("user", Name),
    Column("state", Name, nullable=False),
    Column("words", Words),
)

files = Table(
    "files",
    metadata,
    number_column(),
    vehicle_column(),
    Column("path", Name, nullable=False),  # aboard the vehicle
    Column("size", BigInteger),
    Column("sha256", String(64)),
    Column("t_us", BigInteger, nullable=False),
    Column("direction", String(8), nullable=False),  # download or upload
    Column("user", Name),
    Column("state", Name, nullable=False),
    Column("reason", Words),
    Column("stored_as", Name),  # below the station's folder
    Index("ix_files_vehicle_id_t_us", "vehicle_id", "t_us"),
)

alarms = Table(
    "alarms",
    metadata,
    number_column(),
    vehicle_column(nullable=True),  # none: of the station itself
    Column("key", Name, nullable=False),
    Column("words", Words, nullable=False),
    Column("severity", Name, nullable=False),
    Column("raised_us", BigInteger, nullable=False),
    Column("cleared_us", BigInteger),
    Column("acknowledged_us", BigInteger),
    Column("acknowledged_by", Name),
    Column("value", Double),
    Column("note", Words),
    Index("ix_alarms_vehicle_id_raised_us", "vehicle_id", "raised_us"),
)

limits = Table(
    "limits",
    metadata,
    vehicle_column(key=True),
    Column("channel", Name, primary_key=True),
    Column("low", Double),
    Column("high", Double),
    Column("hysteresis", Double, nullable=False),
    Column("delay_s", Double, nullable=False),
    Column("severity", Name, nullable=False),
    Column("changed_us", BigInteger, nullable=False),
    Column("changed_by", Name, nullable=False),
)

notes = Table(
    "notes",
    metadata,
    number_column(),
    vehicle_column(nullable=True),
    Column("t_us", BigInteger, nullable=False),
    Column("written_us", BigInteger, nullable=False),  # by the station's clock; t_us may be any time before
    Column("user", Name, nullable=False),
    Column("words", Words, nullable=False),
    Index("ix_notes_vehicle_id_t_us", "vehicle_id", "t_us"),
)

users = Table(
    "users",
    metadata,
    Column("name", Name, primary_key=True),
    Column("password_hash", Name, nullable=False),
    Column("role", Name, nullable=False),  # viewer, pilot or admin
    Column("added_us", BigInteger, nullable=False),
    Column("disabled", Boolean, nullable=False),
)

sessions = Table(
    "sessions",
    metadata,
    Column("id_hash", String(64), primary_key=True),
    Column("user", Name, ForeignKey("users.name", ondelete="CASCADE"), nullable=False, index=True),
    Column("made_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger, nullable=False),
    Column("last_used_us", BigInteger),
    Column("address", Name),
)

tokens = Table(
    "tokens",
    metadata,
    number_column(),
    Column("hash", String(64), nullable=False, unique=True),
    Column("user", Name, ForeignKey("users.name", ondelete="CASCADE"), nullable=False, index=True),
    Column("name", Name, nullable=False),
    Column("role", Name, nullable=False),
    Column("made_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger),
    Column("last_used_us", BigInteger),
)

holders = Table(
    "holders",
    metadata,
    Column("vehicle_id", Integer, primary_key=True, autoincrement=False),
    Column("user", Name, nullable=False),  # no key of users: "local" is none of them
    Column("role", Name, nullable=False),
    Column("since_us", BigInteger, nullable=False),
    Column("taken_from", Name),
    Column("reason", Words),
)
"""Who holds command of a vehicle; no row where nobody does."""

audit = Table(
    "audit",
    metadata,
    number_column(),
    Column("t_us", BigInteger, nullable=False, index=True),
    Column("user", Name),
    Column("address", Name),
    Column("action", Name, nullable=False),
    Column("vehicle_id", Integer),  # also of a vehicle that is not there
    Column("detail", JSON(none_as_null=True)),
)

layers = Table(
    "layers",
    metadata,
    number_column(),
    Column("name", Name, nullable=False),
    Column("kind", Name, nullable=False),  # 'geojson' or the media type of an image
    Column("bounds", JSON(none_as_null=True)),  # west, south, east, north [deg]
    Column("content", LargeBinary, nullable=False),
)
