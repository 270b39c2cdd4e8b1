"""What to write where a vehicle file lacks a table that a question needs."""

from stommel.files.table_keys import keys_of, model_at
from stommel.vehicle.schema import VehicleFile


def missing_table(table: str) -> str:
    """Say what [table] is made of, every key at once."""
    return f"[{table}] {keys_of(model_at(VehicleFile, table))}"
