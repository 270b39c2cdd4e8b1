"""Reading plans."""

from pathlib import Path

from stommel.files.toml_reader import read_table
from stommel.mission.plan import Plan


def load_plan(path: str | Path) -> Plan:
    """Read a plan: what a vehicle is told of its mission.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    """
    return read_table(path, Plan)
