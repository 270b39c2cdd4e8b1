"""Until when each mission is tried, so that one that waits goes on waiting after a restart of the station."""

import sqlalchemy as sa
from alembic import op

revision = "stommel_0005"
down_revision = "stommel_0004"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add it; of missions before, nobody knows any more."""
    op.add_column("missions", sa.Column("until_us", sa.BigInteger()))
    op.execute("UPDATE vehicles SET profiles_change = 0")  # all are found once again, with the right mean longitude
