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
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
)

metadata = MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "fk": "fk_%(table_name)s_%(column_0_N_name)s",
        "pk": "pk_%(table_name)s",
    }
)

_NUMBER = BigInteger().with_variant(Integer, "sqlite")
"""Of rows counted by the database; only INTEGER counts by itself in SQLite."""


def _id() -> Column[int]:
    return Column("id", _NUMBER, primary_key=True, autoincrement=True)


def _vehicle(*, key: bool = False, nullable: bool = False) -> Column[int]:
    return Column("vehicle_id", Integer, ForeignKey("vehicles.id"), primary_key=key, nullable=nullable)


vehicles = Table(
    "vehicles",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=False),  # its system number on the link
    Column("name", String, nullable=False),
    Column("model", String, nullable=False),  # name of its vehicle file, or ""
    Column("added_us", BigInteger, nullable=False),
    Column("ctd_changes", BigInteger, nullable=False, server_default="0"),  # how often its CTD samples have changed
    Column("profiles_change", BigInteger, nullable=False, server_default="0"),  # up to which `profiles` are known
)

frames = Table(
    "frames",
    metadata,
    _id(),
    _vehicle(),
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
    Column("key", String, nullable=False, unique=True),
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
    _id(),
    _vehicle(),
    Column("t_us", BigInteger, nullable=False),
    Column("severity", Integer, nullable=False),  # MAVLink's: 0 emergency ... 7 debug
    Column("words", Text, nullable=False),
    Index("ix_texts_vehicle_id_t_us", "vehicle_id", "t_us"),
)

dives = Table(
    "dives",
    metadata,
    _vehicle(key=True),
    Column("dive", BigInteger, primary_key=True, autoincrement=False),
    Column("t_begin_us", BigInteger, primary_key=True, autoincrement=False),
    Column("t_end_us", BigInteger),
    Column("latitude_begin", Double),
    Column("longitude_begin", Double),
    Column("latitude_end", Double),
    Column("longitude_end", Double),
    Column("greatest_depth_m", Double),
    Column("current_north_m_s", Double),
    Column("current_east_m_s", Double),
    Column("energy_j", Double),
    Column("log_id", _NUMBER),  # of the log that told of it; none: the radio alone
)

ctd = Table(
    "ctd",
    metadata,
    _vehicle(key=True),
    Column("t_us", BigInteger, primary_key=True, autoincrement=False),
    Column("dive", BigInteger),
    Column("pressure_dbar", Double),
    Column("temperature_degc", Double),
    Column("conductivity_s_m", Double),
    Column("log_id", _NUMBER),  # of the log that it is from; none: it came by radio
    sqlite_with_rowid=False,
)

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
    _id(),
    _vehicle(),
    Column("sha256", String(64), nullable=False),
    Column("name", String, nullable=False),
    Column("size", BigInteger, nullable=False),
    Column("series", String, nullable=False),  # as its header says
    Column("software", String, nullable=False),
    Column("state", String, nullable=False),  # going, taken or refused
    Column("words", Text, nullable=False),  # whether it was whole; why it was refused
    Column("offset", BigInteger, nullable=False),  # up to where it is in the archive [byte]
    Column("records", BigInteger, nullable=False),
    Column("samples", BigInteger, nullable=False),
    Column("dives", BigInteger, nullable=False),
    Column("begin_us", BigInteger),
    Column("end_us", BigInteger),
    Column("changed_us", BigInteger, nullable=False),  # by the station's clock
    UniqueConstraint("vehicle_id", "sha256"),
)
"""Files of vehicles' logs that were taken in, each once by its content; telemetry from begin to end is from it too."""

commands = Table(
    "commands",
    metadata,
    Column("id", String(16), primary_key=True),  # 64 bits in hexadecimal
    _vehicle(),
    Column("user", String, nullable=False),
    Column("given_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger, nullable=False),
    Column("name", String, nullable=False),
    Column("parameters", JSON, nullable=False),
    Column("occasion", String, nullable=False),  # when it may be executed: at_once, at_next_surfacing, until_expiry
    Column("state", String, nullable=False),
    Column("outcome", Text),
    Column("changed_us", BigInteger, nullable=False),
    Index("ix_commands_vehicle_id_given_us", "vehicle_id", "given_us"),
)

command_history = Table(
    "command_history",
    metadata,
    _id(),
    Column("command_id", String(16), ForeignKey("commands.id"), nullable=False, index=True),
    Column("t_us", BigInteger, nullable=False),
    Column("state", String, nullable=False),
    Column("words", Text),
)

parameters = Table(
    "parameters",
    metadata,
    _id(),
    _vehicle(),
    Column("component", Integer, nullable=False),
    Column("name", String, nullable=False),
    Column("value", Double, nullable=False),
    Column("kind", String, nullable=False),
    Column("t_us", BigInteger, nullable=False),
    Column("user", String),
    Column("source", String, nullable=False),  # 'vehicle' or 'written'
    Index("ix_parameters_vehicle_id_component_name_t_us", "vehicle_id", "component", "name", "t_us"),
)
"""History: the newest row of a name is what it is."""

missions = Table(
    "missions",
    metadata,
    _id(),
    _vehicle(),
    Column("t_us", BigInteger, nullable=False),
    Column("user", String),
    Column("name", String, nullable=False),
    Column("sha256", String(64), nullable=False),
    Column("orders", Text, nullable=False),
    Column("plan", JSON(none_as_null=True)),
    Column("preview", JSON(none_as_null=True)),
    Column("state", String, nullable=False),
    Index("ix_missions_vehicle_id_t_us", "vehicle_id", "t_us"),
)

mission_history = Table(
    "mission_history",
    metadata,
    _id(),
    Column("mission_id", _NUMBER, ForeignKey("missions.id"), nullable=False, index=True),
    Column("t_us", BigInteger, nullable=False),
    Column("user", String),
    Column("state", String, nullable=False),
    Column("words", Text),
)

files = Table(
    "files",
    metadata,
    _id(),
    _vehicle(),
    Column("path", String, nullable=False),  # aboard the vehicle
    Column("size", BigInteger),
    Column("sha256", String(64)),
    Column("t_us", BigInteger, nullable=False),
    Column("direction", String(8), nullable=False),  # download or upload
    Column("user", String),
    Column("state", String, nullable=False),
    Column("reason", Text),
    Column("stored_as", String),  # below the station's folder
    Index("ix_files_vehicle_id_t_us", "vehicle_id", "t_us"),
)

alarms = Table(
    "alarms",
    metadata,
    _id(),
    _vehicle(nullable=True),  # none: of the station itself
    Column("key", String, nullable=False),
    Column("words", Text, nullable=False),
    Column("severity", String, nullable=False),
    Column("raised_us", BigInteger, nullable=False),
    Column("cleared_us", BigInteger),
    Column("acknowledged_us", BigInteger),
    Column("acknowledged_by", String),
    Column("value", Double),
    Column("note", Text),
    Index("ix_alarms_vehicle_id_raised_us", "vehicle_id", "raised_us"),
)

limits = Table(
    "limits",
    metadata,
    _vehicle(key=True),
    Column("channel", String, primary_key=True),
    Column("low", Double),
    Column("high", Double),
    Column("hysteresis", Double, nullable=False),
    Column("delay_s", Double, nullable=False),
    Column("severity", String, nullable=False),
    Column("changed_us", BigInteger, nullable=False),
    Column("changed_by", String, nullable=False),
)

notes = Table(
    "notes",
    metadata,
    _id(),
    _vehicle(nullable=True),
    Column("t_us", BigInteger, nullable=False),
    Column("written_us", BigInteger, nullable=False),  # by the station's clock; t_us may be any time before
    Column("user", String, nullable=False),
    Column("words", Text, nullable=False),
    Index("ix_notes_vehicle_id_t_us", "vehicle_id", "t_us"),
)

users = Table(
    "users",
    metadata,
    Column("name", String, primary_key=True),
    Column("password_hash", String, nullable=False),
    Column("role", String, nullable=False),  # viewer, pilot or admin
    Column("added_us", BigInteger, nullable=False),
    Column("disabled", Boolean, nullable=False),
)

sessions = Table(
    "sessions",
    metadata,
    Column("id_hash", String(64), primary_key=True),
    Column("user", String, ForeignKey("users.name", ondelete="CASCADE"), nullable=False, index=True),
    Column("made_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger, nullable=False),
    Column("last_used_us", BigInteger),
    Column("address", String),
)

tokens = Table(
    "tokens",
    metadata,
    _id(),
    Column("hash", String(64), nullable=False, unique=True),
    Column("user", String, ForeignKey("users.name", ondelete="CASCADE"), nullable=False, index=True),
    Column("name", String, nullable=False),
    Column("role", String, nullable=False),
    Column("made_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger),
    Column("last_used_us", BigInteger),
)

holders = Table(
    "holders",
    metadata,
    Column("vehicle_id", Integer, primary_key=True, autoincrement=False),
    Column("user", String, nullable=False),  # no key of users: "local" is none of them
    Column("role", String, nullable=False),
    Column("since_us", BigInteger, nullable=False),
    Column("taken_from", String),
    Column("reason", Text),
)
"""Who holds command of a vehicle; no row where nobody does."""

audit = Table(
    "audit",
    metadata,
    _id(),
    Column("t_us", BigInteger, nullable=False, index=True),
    Column("user", String),
    Column("address", String),
    Column("action", String, nullable=False),
    Column("vehicle_id", Integer),  # also of a vehicle that is not there
    Column("detail", JSON(none_as_null=True)),
)

layers = Table(
    "layers",
    metadata,
    _id(),
    Column("name", String, nullable=False),
    Column("kind", String, nullable=False),  # 'geojson' or the media type of an image
    Column("bounds", JSON(none_as_null=True)),  # west, south, east, north [deg]
    Column("content", LargeBinary, nullable=False),
)
