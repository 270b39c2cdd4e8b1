"""What the tables of the archive have in common: names of rules, numbers of rows, the vehicle of a row."""

from sqlalchemy import BigInteger, Column, Double, ForeignKey, Integer, MetaData

metadata = MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "fk": "fk_%(table_name)s_%(column_0_N_name)s",
        "pk": "pk_%(table_name)s",
    }
)

NUMBER = BigInteger().with_variant(Integer, "sqlite")
"""Of rows counted by the database; only INTEGER counts by itself in SQLite."""


def number_column() -> Column[int]:
    """Number of a row, counted by the database."""
    return Column("id", NUMBER, primary_key=True, autoincrement=True)


def vehicle_column(*, key: bool = False, nullable: bool = False) -> Column[int]:
    """Vehicle of a row."""
    return Column("vehicle_id", Integer, ForeignKey("vehicles.id"), primary_key=key, nullable=nullable)


def value_columns(*names: str) -> list[Column[float]]:
    """Values that may be unknown."""
    return [Column(name, Double) for name in names]
