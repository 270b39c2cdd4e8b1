"""The tables of the first version."""

from stommel.archive.migrations.first_version.doings import make_doings
from stommel.archive.migrations.first_version.telemetry import make_telemetry

revision = "stommel_0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Make all tables."""
    make_telemetry()
    make_doings()
