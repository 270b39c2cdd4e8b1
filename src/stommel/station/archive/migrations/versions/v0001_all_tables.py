"""The tables of the first version."""

from alembic import op

from stommel.station.archive.schema import metadata

revision = "stommel_0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Make all tables."""
    metadata.create_all(op.get_bind())
