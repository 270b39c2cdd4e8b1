"""Missions that come with stommel, by name."""

from importlib.resources import files
from pathlib import Path

from stommel.errors import StommelError
from stommel.files.nearest import did_you_mean
from stommel.files.opening import names_file
from stommel.files.toml_reader import read_toml


class UnknownMissionError(StommelError):
    """Neither a shipped mission nor a file."""


def shipped_missions() -> dict[str, str]:
    """Names of the shipped missions, with their titles."""
    found = sorted(_folder().glob("*.toml"))
    return {path.stem: str(read_toml(path)["name"]) for path in found}


def mission_path(name: str) -> Path:
    """Path of a mission file, or of the shipped mission of this name.

    Raises
    ------
    UnknownMissionError
        No shipped mission has this name, and it is not that of a file.
    """
    if names_file(name):
        return Path(name)
    names = shipped_missions()
    if name in names:
        return _folder() / f"{name}.toml"
    raise UnknownMissionError(
        f"mission {name!r} is neither a file nor a shipped mission{did_you_mean(name, names)} shipped: "
        f"{', '.join(names)}"
    )


def _folder() -> Path:
    return Path(str(files(__package__))) / "missions"
