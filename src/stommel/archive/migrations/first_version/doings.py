"""Tables of the first version for what people do, as they were then."""

import sqlalchemy as sa
from alembic import op

_NUMBER = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def make_doings() -> None:
    """Make them, those first that others name."""
    _make_audit()
    _make_holders()
    _make_layers()
    _make_users()
    _make_alarms()
    _make_commands()
    _make_files()
    _make_limits()
    _make_missions()
    _make_notes()
    _make_parameters()
    _make_parameter_writes()
    _make_sessions()
    _make_tokens()
    _make_command_history()
    _make_mission_history()


def _make_audit() -> None:
    op.create_table(
        "audit",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("user", sa.String()),
        sa.Column("address", sa.String()),
        sa.Column("action", sa.String(), nullable=False),
        sa.Column("vehicle_id", sa.Integer()),
        sa.Column("detail", sa.JSON(none_as_null=True)),
        sa.PrimaryKeyConstraint("id", name="pk_audit"),
    )
    op.create_index("ix_audit_t_us", "audit", ["t_us"])


def _make_holders() -> None:
    op.create_table(
        "holders",
        sa.Column("vehicle_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("role", sa.String(), nullable=False),
        sa.Column("since_us", sa.BigInteger(), nullable=False),
        sa.Column("taken_from", sa.String()),
        sa.Column("reason", sa.Text()),
        sa.PrimaryKeyConstraint("vehicle_id", name="pk_holders"),
    )


def _make_layers() -> None:
    op.create_table(
        "layers",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("kind", sa.String(), nullable=False),
        sa.Column("bounds", sa.JSON(none_as_null=True)),
        sa.Column("content", sa.LargeBinary(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_layers"),
    )


def _make_users() -> None:
    op.create_table(
        "users",
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("password_hash", sa.String(), nullable=False),
        sa.Column("role", sa.String(), nullable=False),
        sa.Column("added_us", sa.BigInteger(), nullable=False),
        sa.Column("disabled", sa.Boolean(), nullable=False),
        sa.PrimaryKeyConstraint("name", name="pk_users"),
    )


def _make_alarms() -> None:
    op.create_table(
        "alarms",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer()),
        sa.Column("key", sa.String(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.Column("severity", sa.String(), nullable=False),
        sa.Column("raised_us", sa.BigInteger(), nullable=False),
        sa.Column("cleared_us", sa.BigInteger()),
        sa.Column("acknowledged_us", sa.BigInteger()),
        sa.Column("acknowledged_by", sa.String()),
        sa.Column("value", sa.Double()),
        sa.Column("note", sa.Text()),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_alarms_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_alarms"),
    )
    op.create_index("ix_alarms_vehicle_id_raised_us", "alarms", ["vehicle_id", "raised_us"])


def _make_commands() -> None:
    op.create_table(
        "commands",
        sa.Column("id", sa.String(length=16), nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("given_us", sa.BigInteger(), nullable=False),
        sa.Column("expires_us", sa.BigInteger(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("parameters", sa.JSON(), nullable=False),
        sa.Column("occasion", sa.String(), nullable=False),
        sa.Column("state", sa.String(), nullable=False),
        sa.Column("outcome", sa.Text()),
        sa.Column("changed_us", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_commands_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_commands"),
    )
    op.create_index("ix_commands_vehicle_id_given_us", "commands", ["vehicle_id", "given_us"])


def _make_files() -> None:
    op.create_table(
        "files",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("path", sa.String(), nullable=False),
        sa.Column("size", sa.BigInteger()),
        sa.Column("sha256", sa.String(length=64)),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("direction", sa.String(length=8), nullable=False),
        sa.Column("user", sa.String()),
        sa.Column("state", sa.String(), nullable=False),
        sa.Column("reason", sa.Text()),
        sa.Column("stored_as", sa.String()),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_files_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_files"),
    )
    op.create_index("ix_files_vehicle_id_t_us", "files", ["vehicle_id", "t_us"])


def _make_limits() -> None:
    op.create_table(
        "limits",
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("channel", sa.String(), nullable=False),
        sa.Column("low", sa.Double()),
        sa.Column("high", sa.Double()),
        sa.Column("hysteresis", sa.Double(), nullable=False),
        sa.Column("delay_s", sa.Double(), nullable=False),
        sa.Column("severity", sa.String(), nullable=False),
        sa.Column("changed_us", sa.BigInteger(), nullable=False),
        sa.Column("changed_by", sa.String(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_limits_vehicle_id"),
        sa.PrimaryKeyConstraint("vehicle_id", "channel", name="pk_limits"),
    )


def _make_missions() -> None:
    op.create_table(
        "missions",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("user", sa.String()),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("sha256", sa.String(length=64), nullable=False),
        sa.Column("orders", sa.Text(), nullable=False),
        sa.Column("plan", sa.JSON(none_as_null=True)),
        sa.Column("preview", sa.JSON(none_as_null=True)),
        sa.Column("state", sa.String(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_missions_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_missions"),
    )
    op.create_index("ix_missions_vehicle_id_t_us", "missions", ["vehicle_id", "t_us"])


def _make_notes() -> None:
    op.create_table(
        "notes",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer()),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("written_us", sa.BigInteger(), nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_notes_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_notes"),
    )
    op.create_index("ix_notes_vehicle_id_t_us", "notes", ["vehicle_id", "t_us"])


def _make_parameters() -> None:
    op.create_table(
        "parameters",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("component", sa.Integer(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("value", sa.Double(), nullable=False),
        sa.Column("kind", sa.String(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("user", sa.String()),
        sa.Column("source", sa.String(), nullable=False),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_parameters_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_parameters"),
    )
    op.create_index(
        "ix_parameters_vehicle_id_component_name_t_us", "parameters", ["vehicle_id", "component", "name", "t_us"]
    )


def _make_parameter_writes() -> None:
    op.create_table(
        "parameter_writes",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("vehicle_id", sa.Integer(), nullable=False),
        sa.Column("component", sa.Integer(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("value", sa.Double(), nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("state", sa.String(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.Column("holds", sa.Double()),
        sa.ForeignKeyConstraint(["vehicle_id"], ["vehicles.id"], name="fk_parameter_writes_vehicle_id"),
        sa.PrimaryKeyConstraint("id", name="pk_parameter_writes"),
    )
    op.create_index("ix_parameter_writes_vehicle_id_id", "parameter_writes", ["vehicle_id", "id"])


def _make_sessions() -> None:
    op.create_table(
        "sessions",
        sa.Column("id_hash", sa.String(length=64), nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("made_us", sa.BigInteger(), nullable=False),
        sa.Column("expires_us", sa.BigInteger(), nullable=False),
        sa.Column("last_used_us", sa.BigInteger()),
        sa.Column("address", sa.String()),
        sa.ForeignKeyConstraint(["user"], ["users.name"], name="fk_sessions_user", ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("id_hash", name="pk_sessions"),
    )
    op.create_index("ix_sessions_user", "sessions", ["user"])


def _make_tokens() -> None:
    op.create_table(
        "tokens",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("hash", sa.String(length=64), nullable=False),
        sa.Column("user", sa.String(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("role", sa.String(), nullable=False),
        sa.Column("made_us", sa.BigInteger(), nullable=False),
        sa.Column("expires_us", sa.BigInteger()),
        sa.Column("last_used_us", sa.BigInteger()),
        sa.ForeignKeyConstraint(["user"], ["users.name"], name="fk_tokens_user", ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("id", name="pk_tokens"),
        sa.UniqueConstraint("hash", name="uq_tokens_hash"),
    )
    op.create_index("ix_tokens_user", "tokens", ["user"])


def _make_command_history() -> None:
    op.create_table(
        "command_history",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("command_id", sa.String(length=16), nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("state", sa.String(), nullable=False),
        sa.Column("words", sa.Text()),
        sa.ForeignKeyConstraint(["command_id"], ["commands.id"], name="fk_command_history_command_id"),
        sa.PrimaryKeyConstraint("id", name="pk_command_history"),
    )
    op.create_index("ix_command_history_command_id", "command_history", ["command_id"])


def _make_mission_history() -> None:
    op.create_table(
        "mission_history",
        sa.Column("id", _NUMBER, autoincrement=True, nullable=False),
        sa.Column("mission_id", _NUMBER, nullable=False),
        sa.Column("t_us", sa.BigInteger(), nullable=False),
        sa.Column("user", sa.String()),
        sa.Column("state", sa.String(), nullable=False),
        sa.Column("words", sa.Text()),
        sa.ForeignKeyConstraint(["mission_id"], ["missions.id"], name="fk_mission_history_mission_id"),
        sa.PrimaryKeyConstraint("id", name="pk_mission_history"),
    )
    op.create_index("ix_mission_history_mission_id", "mission_history", ["mission_id"])
